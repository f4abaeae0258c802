"""Everyday tasks at a kitchen table."""
