"""The benchmark: bit error rates of schemes and decoders over exposure and noise."""
