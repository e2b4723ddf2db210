"""Work outside the window's thread, with its results as signals."""
