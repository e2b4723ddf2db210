"""Cases that are hard on numbers, far beyond the sliders, against references of more digits."""
