"""The story of one picture: light, stripes, profile and code over one axis of columns."""
