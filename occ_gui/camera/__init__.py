"""The dialog that measures the user's camera by lamps on the mains."""
