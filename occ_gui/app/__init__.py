"""Start of the program: command line, and the connection of all parts of the window."""
