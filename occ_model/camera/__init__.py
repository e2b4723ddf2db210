"""The camera: exposure, pixel values, projection, optics and sensor."""
