"""The column profile of simulation, band model and photo."""
