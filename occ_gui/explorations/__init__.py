"""The guided explorations."""
