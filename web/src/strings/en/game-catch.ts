// Catching.
export const gameCatch = {
  "game.catch": "Butterflies",
  "game.catch.aim": "Timing: being in the right place at the right moment",
  "game.catch.how": "Bring your hand into the ring before the butterfly comes: it settles on your hand.",
} as const;
