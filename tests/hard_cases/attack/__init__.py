"""Inputs made by chance for every door of the program: each gives a result or a sentence."""
