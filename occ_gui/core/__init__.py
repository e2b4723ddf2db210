"""The document of the window: what the user has set, with undo."""
