"""The desktop application: sliders on the model, the picture, and what was read from it."""
