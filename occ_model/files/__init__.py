"""Files: written complete or not at all, and read only if they are what they should be."""
