"""What a body is and how evidence about it is joined: pure functions and values, no sockets, clocks or threads."""
