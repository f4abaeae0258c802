"""CiA 402 drives that are not there: a node per joint, over any python-can bus, with faults that can be asked for."""
