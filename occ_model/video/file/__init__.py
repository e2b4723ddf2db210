"""Films in files: reading in a separate decoding process, and writing."""
