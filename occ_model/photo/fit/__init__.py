"""Fit the exposure model to the stripes in a photo."""
