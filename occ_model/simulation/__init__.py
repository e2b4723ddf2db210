"""Simulation of a picture: columns, then pixels, each stage timed."""
