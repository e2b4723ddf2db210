"""The exposure model fitted to the stripes."""
