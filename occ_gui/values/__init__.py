"""Values that the workspace consists of, and values that results consist of."""
