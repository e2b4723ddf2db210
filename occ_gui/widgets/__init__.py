"""Controls and small displays, made from parameter declarations."""
