"""What a command of ``occ-model`` can end with, besides 0."""

EXIT_FAILURE = 1
"""Nothing was wrong with the command, but no code could be read, or it could not be finished."""

EXIT_MISUSE = 2
"""The command asked for something that cannot be."""

EXIT_INTERRUPTED = 130
"""Ctrl-C ended it: 128 and the signal's number, as shells have it."""
