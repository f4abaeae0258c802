"""Where tags are, from radio ranges to anchors, with inertial help [Shi]."""
