"""Effects of a real camera that the paper's model lacks, and the plan that selects them."""
