"""Teaching material about a scene: equations, the exposure of columns, guided lessons."""
