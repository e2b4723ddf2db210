"""Figures and tables for print; the only part that draws."""

from occ_model.figures.matplotlib_import import import_matplotlib

# Before any module of this folder imports matplotlib by itself.
import_matplotlib()
