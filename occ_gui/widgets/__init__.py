"""Widgets and plot elements that several panes use."""
