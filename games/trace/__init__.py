"""Tracing a path through space."""
