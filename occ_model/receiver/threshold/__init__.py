"""The paper's decoder: Otsu's threshold and the lengths of runs."""
