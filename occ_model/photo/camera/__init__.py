"""Measure a camera's readout time by the bars of lamps on the mains, without equipment."""
