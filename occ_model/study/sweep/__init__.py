"""Success rates over many parameters, in several processes, written as they come."""
