"""The first page that a new user sees: three ways to begin."""
