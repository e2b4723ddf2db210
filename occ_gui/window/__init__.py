"""The main window: menus, docks, theme, and its commands by name."""
