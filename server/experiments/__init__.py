"""Experiments that need the station: the exoskeleton, its safety gate, its drives and its processes."""
