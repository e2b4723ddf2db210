"""Sweeps: success rates over any parameters, by several processes, continued from a file."""
