"""Figures and tables for print; the only part that draws."""
