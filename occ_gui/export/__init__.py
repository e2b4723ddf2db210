"""Panes as figures and tables in files."""
