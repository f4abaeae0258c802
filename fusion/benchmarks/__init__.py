"""How long our work takes, each figure beside a baseline from the same run."""
