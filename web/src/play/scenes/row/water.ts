/** Height of the water in the trunk frame: below the boat's deck, which lies at `TABLE_Y`. */
export const WATER_Y = -0.74;
