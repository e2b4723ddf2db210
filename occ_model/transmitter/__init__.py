"""The transmitter: from a code to the waveform of the light."""
