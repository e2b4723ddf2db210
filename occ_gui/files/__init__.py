"""Files: scenes, presets, preferences and the session."""
