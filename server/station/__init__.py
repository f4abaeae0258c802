"""The station: the real-time process at one therapy place. Knows nothing of the web."""
