"""The detection map, the strips under the sliders, and the advice on the limits of decoding."""
