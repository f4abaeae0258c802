"""Wiping a misted window."""
