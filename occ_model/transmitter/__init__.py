"""The transmitter: from a code to the light's waveform."""
