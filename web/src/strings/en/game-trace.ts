// Tracing.
export const gameTrace = {
  "game.trace": "Lantern path",
  "game.trace.aim": "Smoothness and accuracy: a steady hand on a winding path",
  "game.trace.how": "Bring your hand to the lantern and lead it slowly along the path to the flower.",
} as const;
