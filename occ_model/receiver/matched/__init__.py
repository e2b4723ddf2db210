"""The matched decoder, which correlates a signal with the model of every code and phase."""
