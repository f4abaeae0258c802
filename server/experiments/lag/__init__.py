"""How far a filtered target comes behind the arm it follows, and how far off it is."""
