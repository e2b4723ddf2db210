"""The simulated picture, the picture before the latest change, and a photo beside or over it."""
