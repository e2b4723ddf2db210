"""Boards that blink a scene: their sketches, the waveform as files, and the wiring."""
