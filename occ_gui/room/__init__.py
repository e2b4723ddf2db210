"""Pane of the room: plan, picture, and the place of the camera by the picture."""
