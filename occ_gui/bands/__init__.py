"""How deep the bars of a picture are, and which settings show none."""
