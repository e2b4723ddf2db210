"""Work off the window's thread, and its results as signals."""
