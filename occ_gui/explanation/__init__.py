"""The equations with their numbers, and the exposure of one column."""
