"""The experiments, one file each; `EXPERIMENT` in it is all that the registry needs."""
