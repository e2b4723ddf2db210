"""Figures and tables for print; the only package that imports matplotlib."""

from occ_model.figures.matplotlib_import import import_matplotlib

# Before any module of this package imports matplotlib.
import_matplotlib()
