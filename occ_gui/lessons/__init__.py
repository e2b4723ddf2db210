"""Guided lessons: scenes with questions, step by step."""
