"""The first page that a new user sees: four ways to begin."""
