"""The matched decoder: correlation with the forward model of every code and phase."""
