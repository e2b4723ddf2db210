"""From what the user does to the model's work, and from its results to the views."""
