"""The sequence detector: the most likely chips, each exposure a moving average of several."""
