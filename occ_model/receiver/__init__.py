"""From an image back to the code."""
