"""A real photo: loading it, comparing it with the simulation, and matching the scene to it."""
