"""Photo files: from bytes to one grey picture, and what the camera noted."""
