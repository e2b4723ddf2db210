"""Several lamps in one photo: where they are, how they blink, and the match of each."""
