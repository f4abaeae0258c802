"""Wire dialects: one file each, decode and encode, no sockets."""
