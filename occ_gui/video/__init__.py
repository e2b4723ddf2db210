"""Films: opening, simulating and reading them, and a camera that is read while it films."""
