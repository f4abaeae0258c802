"""What a session measured, each metric with its formula and source (docs/metrics.md)."""
