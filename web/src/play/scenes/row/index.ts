// Rowing: both hands paddle a boat over a morning lake between steep hills; lotus opens beside every good stroke.
import type { OpenScene } from "../../scene";
import { lake } from "./lake";
import { Voyage } from "./voyage";

export const open: OpenScene = (side) => new Voyage(side, lake());
