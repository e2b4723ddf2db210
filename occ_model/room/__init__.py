"""A room: many lamps, each with its code, and one camera that looks for its own place."""
