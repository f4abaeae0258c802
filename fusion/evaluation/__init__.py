"""How far the fused body is from the truth: every method and every single sensor over a recording."""
