"""The receiver, which reads the code from an image."""
