"""The light of a panel or lamp over time, and its exact integral over exposures."""
