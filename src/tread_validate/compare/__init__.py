"""Comparison of runs with their references."""
