"""Guided explorations: scenes with questions, step by step."""
