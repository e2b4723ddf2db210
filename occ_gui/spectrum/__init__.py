"""Spectrum of the profile and histogram of the picture of the present scene."""
