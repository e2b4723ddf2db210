"""Scene: the store of the current scene, and the controls that edit it."""
