"""Types of the model's results: pictures, plans, decodings, matches, studies."""
