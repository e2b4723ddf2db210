"""Pane of the room: plan, picture, and where the picture says that it was taken."""
