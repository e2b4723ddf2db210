"""What speaks for and against an explanation of a photo's stripes."""
