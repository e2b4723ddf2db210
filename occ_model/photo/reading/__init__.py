"""Read photo files: from bytes to one channel's samples, with the camera's EXIF data."""
