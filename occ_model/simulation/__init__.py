"""Simulation of a picture: first columns, then pixels, with the time of each stage."""
