"""What experiments measure: pure functions of recordings and methods, without tables or pictures."""
