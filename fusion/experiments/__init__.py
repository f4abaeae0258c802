"""The papers' tables and figures made again, each by one experiment in a file of its own."""
