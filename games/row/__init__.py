"""Rowing with both hands."""
