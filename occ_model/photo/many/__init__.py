"""Match many photos, and combine what they measured."""
