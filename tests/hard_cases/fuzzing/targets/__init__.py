"""The fuzz targets: how each gets its inputs, and the laws of its results."""
