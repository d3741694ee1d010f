"""The fast march: exact modes, contacts in few coordinates, steps by error."""
