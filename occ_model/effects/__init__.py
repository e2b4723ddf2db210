"""Effects that the paper's model leaves out, and the plan that chooses among them."""
