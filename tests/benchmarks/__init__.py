"""Scripts that measure; their parts are imported by tests as well."""
