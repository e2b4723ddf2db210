"""Questions asked of many scenes."""
