"""Figures and tables for print. No other package imports matplotlib."""

from occ_model.figures.matplotlib_import import import_matplotlib

# This comes before any module of this package imports matplotlib.
import_matplotlib()
