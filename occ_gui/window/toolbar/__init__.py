"""Toolbar: the commands that are used most, as icons."""
