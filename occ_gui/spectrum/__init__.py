"""Spectrum of the profile and histogram of the picture, measured on the present scene."""
