"""Declarations of the window's panes, and the docks, menu entries and figures made from them."""
