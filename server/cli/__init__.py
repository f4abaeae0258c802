"""The `mirrorlimb` commands, one file each."""
