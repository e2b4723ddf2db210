"""Mutation testing: faults are put into a copy of the program, and tests have to find them."""
