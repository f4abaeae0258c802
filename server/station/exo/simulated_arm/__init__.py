"""The simulated seven-joint exoskeleton with a passive human arm in it (docs/simulated-arm.md)."""
