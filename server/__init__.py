"""mirrorlimb: mirror therapy with several sensors and an exoskeleton."""

__version__ = "0.1.0"
