"""Catching what comes on the breeze."""
