"""The station's loop with its clock turned by hand: everything is real but time, wires and people."""
