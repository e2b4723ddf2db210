"""Depth of the bars in a picture, settings without bars, and flicker for the eye."""
