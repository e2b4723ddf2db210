"""The bench: bit error rates and bits a second over exposure and noise, for each decoder."""
