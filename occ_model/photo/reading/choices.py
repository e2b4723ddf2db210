"""Choices for reading a photo, in a module of their own because the reader is slow to import."""

SCAN_AXES = ("auto", "columns", "lines")
"""The axis of the file that the rolling shutter scanned; ``"auto"``: the one across the stripes."""

CHANNELS = ("brightest", "luma", "red", "green", "blue")
"""The channels of a colour photo; ``"brightest"`` is the colour with the largest mean."""
