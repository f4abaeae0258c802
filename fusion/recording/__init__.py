"""Recordings: the interchange folder and the crash-safe live form."""
