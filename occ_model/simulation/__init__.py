"""From scene to picture: columns, then pixels, each stage timed."""
