"""Pane of the room: plan, picture, and the camera's place found from the picture."""
