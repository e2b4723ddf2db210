"""The scene simulated and decoded off the window's thread."""
