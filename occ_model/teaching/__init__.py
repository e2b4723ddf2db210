"""Teaching material on a scene: its equations, a column's exposure, guided lessons."""
