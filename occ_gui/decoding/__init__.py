"""The result of decoding and the steps to it."""
