"""What helps to understand a scene: its equations, a column's exposure, guided explorations."""
