"""Desktop application: sliders on the model, the simulated picture and its decoding."""
