"""Emulated devices of equal standing with real ones: each speaks the real protocol and can be made to fail."""
