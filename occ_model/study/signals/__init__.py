"""What decoders read from many pictures at once, simulated without their pixels."""
