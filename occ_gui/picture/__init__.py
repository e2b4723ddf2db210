"""The simulated picture, with a photo on it."""
