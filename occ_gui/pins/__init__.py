"""Comparison of two pinned scenes, A and B."""
