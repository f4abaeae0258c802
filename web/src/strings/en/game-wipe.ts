// Wiping.
export const gameWipe = {
  "game.wipe": "Misted window",
  "game.wipe.aim": "Range and endurance: wide strokes over the whole reach",
  "game.wipe.how": "Move your hand over the marked mist and wipe it away. What is behind the window?",
} as const;
