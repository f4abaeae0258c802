"""Real processes under measurement: a station, a drive with a process of its own, a patient whose wires can be cut."""
