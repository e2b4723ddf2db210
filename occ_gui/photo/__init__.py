"""A real photo: opened, matched, compared."""
