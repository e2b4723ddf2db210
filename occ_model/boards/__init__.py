"""Microcontroller boards that blink a scene: sketches, waveform files and timing."""
