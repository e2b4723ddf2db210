"""Modes of the window: one for each task, with panes laid out for it."""
