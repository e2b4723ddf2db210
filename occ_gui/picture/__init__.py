"""The simulated picture, the one before the latest change, and a photo beside or over it."""
