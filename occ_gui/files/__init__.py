"""Scenes, presets and the session in files."""
