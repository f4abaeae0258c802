"""The web side of the service: speaks to the station only by messages."""
