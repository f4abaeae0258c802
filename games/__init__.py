"""The rules of the games: pure, seeded, replayable; the browser only draws."""
