"""Fuzzing: random inputs for every part of the program that takes input from outside."""
