"""The dialog that writes the files that a microcontroller board needs to send the scene."""
