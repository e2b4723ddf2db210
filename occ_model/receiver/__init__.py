"""The receiver: from an image back to the code."""
