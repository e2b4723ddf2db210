"""Films in files: the kinds that are read and written, their frames decoded in a process apart."""
