"""What a scene keeps and what it leaves out, and what that changes of its curve."""
