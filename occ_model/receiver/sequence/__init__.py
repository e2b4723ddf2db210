"""The sequence detector, which finds the most likely chips from their moving averages."""
