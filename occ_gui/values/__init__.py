"""Values that the user has set, of which the workspace consists."""
