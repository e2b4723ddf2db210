"""Scenes: frozen values of declared parameters, their files and presets."""
