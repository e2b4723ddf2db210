"""The decode result and its steps."""
