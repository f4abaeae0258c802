// Everyday tasks.
export const gameEveryday = {
  "game.everyday": "Breakfast table",
  "game.everyday.aim": "Everyday tasks: bending the elbow, holding still, one step after the other",
  "game.everyday.how": "Stay at a thing to take it, bring it to the ring and stay there.",
} as const;
