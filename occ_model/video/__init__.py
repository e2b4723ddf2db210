"""Films: simulate them frame by frame, write them to files, open files."""
