"""Read the chips in view from the edges of stripes."""
