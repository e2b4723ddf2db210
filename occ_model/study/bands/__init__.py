"""How deep the bars of a picture are, which settings show none, and what the eye sees."""
