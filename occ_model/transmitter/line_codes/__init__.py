"""Line codes: bits to chips and back, one file a code."""
