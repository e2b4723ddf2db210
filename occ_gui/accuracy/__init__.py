"""Accuracy against computing time: the table of effects and the plot of error over time."""
