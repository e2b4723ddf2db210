"""The column profile beside its comparisons."""
