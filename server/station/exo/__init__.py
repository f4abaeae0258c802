"""The exoskeleton: the safety gate, the driver contract, and one file per drive family."""
