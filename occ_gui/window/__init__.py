"""Main window: menus, docks, colour theme and command palette."""
