"""From a code to the light's waveform."""
