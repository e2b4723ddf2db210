"""Photographs: reading them, finding their stripes, and fitting a scene to them."""
