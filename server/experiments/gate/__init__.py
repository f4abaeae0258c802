"""What the studies of the safety gate share: quick simulated joints, wild inputs, and a judge of every tick."""
