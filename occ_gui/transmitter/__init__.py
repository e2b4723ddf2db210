"""The dialog that writes what a board needs to blink the scene."""
