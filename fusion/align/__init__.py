"""Bringing sensors together: in time, in space, and onto the same person."""
