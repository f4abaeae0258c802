"""Estimators: a base and one sibling file per method."""
