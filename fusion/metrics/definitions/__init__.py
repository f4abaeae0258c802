"""The catalogue's entries, a file per kind of figure; each file's `MEASURES`."""
