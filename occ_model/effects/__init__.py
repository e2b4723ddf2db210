"""What the paper's model leaves out: one file an effect, and the plan that picks them."""
