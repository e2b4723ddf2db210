"""Panes that show results and know no physics."""
