"""Comparison of two pinned states, A and B."""
