"""Every file here is one experiment; `fusion.experiments.registry` finds them by looking."""
