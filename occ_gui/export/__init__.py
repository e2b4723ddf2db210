"""Export of panes as figures and tables."""
