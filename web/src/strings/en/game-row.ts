// Rowing.
export const gameRow = {
  "game.row": "Rowing",
  "game.row.aim": "Both arms together: even strokes",
  "game.row.how": "Reach ahead into the rings with both hands, then pull both back together.",
} as const;
