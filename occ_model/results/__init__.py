"""Result types of the model: pictures, plans, decodings, matches, studies."""
