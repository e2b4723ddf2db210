"""The detection map, the strips under the sliders, and the advice about the limits of decoding."""
