"""Figures and tables for print. No other package imports matplotlib."""
