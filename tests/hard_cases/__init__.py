"""Numerically hard cases, far beyond the sliders, compared with references of more digits."""
