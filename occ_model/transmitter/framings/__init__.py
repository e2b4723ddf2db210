"""Framings: how chips show where a payload starts, one file a framing."""
