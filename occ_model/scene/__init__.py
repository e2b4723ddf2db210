"""Scenes as frozen values of declared parameters, their files, and presets."""
