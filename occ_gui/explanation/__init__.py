"""The equations with the numbers of the present scene, and the exposure of one column."""
