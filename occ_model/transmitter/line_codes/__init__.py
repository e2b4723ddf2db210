"""Line codes: from bits to chips and back. One file each."""
