"""A room: many lamps, each with its own code, and a camera whose place is found from them."""
