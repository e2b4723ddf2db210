"""What the window shows, as values that can be watched."""
