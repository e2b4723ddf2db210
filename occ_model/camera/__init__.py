"""The camera: exposure, projection, optics, sensor and pixel values."""
