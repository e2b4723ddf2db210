"""Effects, their costs, and accuracy against time."""
