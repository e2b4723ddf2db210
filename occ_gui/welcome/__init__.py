"""The first page that a new user sees: three doors into the program."""
