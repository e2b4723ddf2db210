"""The pages of the manual, shown in a window of their own."""
