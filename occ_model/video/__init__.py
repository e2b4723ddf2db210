"""Films: simulation frame by frame, reading of payloads, and opening and writing of files."""
