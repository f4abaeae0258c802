"""Reaching and collecting."""
