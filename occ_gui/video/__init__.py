"""Films: opening, simulating and reading them, and live reading from a camera."""
