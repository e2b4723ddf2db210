"""From the light's waveform to column values, and from column values to the image."""
