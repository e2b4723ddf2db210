"""Simulated photographs of a world that is wider than the model, with the truth beside them."""
