"""The detection map, the strips under the sliders, and the advisor."""
