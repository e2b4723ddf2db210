"""Widgets and elements of plots that several panes use."""
