"""The start of the program, and what joins its parts."""
