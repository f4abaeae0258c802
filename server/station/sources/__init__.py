"""Where samples come from: the only sockets of the station."""
