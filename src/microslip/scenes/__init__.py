"""Built-in scenes, one folder each."""
