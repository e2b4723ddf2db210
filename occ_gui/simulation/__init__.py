"""Simulation and decoding of the scene on a background thread."""
