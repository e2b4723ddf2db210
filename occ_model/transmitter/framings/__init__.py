"""Framings: how chips show where a payload starts. One file each."""
