"""The panes of the window as declarations, and what follows from them: docks, idle, stop."""
