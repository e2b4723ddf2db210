"""Two pinned states, compared."""
