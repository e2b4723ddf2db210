"""Several photos together: their table, and what they measured."""
