"""The scene that is shown, and the controls that change it."""
