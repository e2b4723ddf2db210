"""The stripes in a photo: where they are, which way they run, how often they repeat."""
