"""Studies of many scenes: success rates, sweeps, working ranges, accuracy."""
