"""The bench: bit error rates and bits a second over exposure and noise, detector by detector."""
