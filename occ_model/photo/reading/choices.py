"""What can be chosen where a photo is read: by itself, as reading one imports much."""

SCAN_AXES = ("auto", "columns", "lines")
"""The axis of the file that the rolling shutter scanned; ``"auto"``: the one across the stripes."""

CHANNELS = ("brightest", "luma", "red", "green", "blue")
"""The channels of a coloured photo; ``"brightest"`` is the colour with the largest mean."""
