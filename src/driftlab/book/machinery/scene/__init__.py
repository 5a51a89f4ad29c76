"""Living scenes: bodies in space that turn, curves beside them, one time for both."""
