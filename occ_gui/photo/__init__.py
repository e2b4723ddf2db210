"""A real photo: reading it, comparing it with the simulation, and matching the scene to it."""
