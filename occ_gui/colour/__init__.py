"""The pane of a colour camera: its picture, three profiles, and what each colour says."""
