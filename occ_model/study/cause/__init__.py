"""Find why a picture is not read, by removing possible faults from its scene."""
