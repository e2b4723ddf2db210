"""What a command of ``occ-model`` can end with, besides 0."""

EXIT_FAILURE = 1
"""Nothing was wrong with the command, but no code could be read."""

EXIT_MISUSE = 2
"""The command asked for something that cannot be."""
