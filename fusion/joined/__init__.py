"""One estimator for all evidence about one body: cameras, inertial sensors, a radio tag, and anatomy."""
