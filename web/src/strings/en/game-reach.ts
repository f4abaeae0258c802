// Reaching and collecting.
export const gameReach = {
  "game.reach": "Picking fruit",
  "game.reach.aim": "Range of movement: reaching further, bit by bit",
  "game.reach.how": "Bring your hand to the fruit and keep it there until the ring is full.",
} as const;
