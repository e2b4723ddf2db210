"""Files: read within bounds, written complete or not at all, and those of the package."""
