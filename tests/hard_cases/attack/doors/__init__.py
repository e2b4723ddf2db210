"""The doors, a file each: what comes in, and what has to hold of what comes out."""
