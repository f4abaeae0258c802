// Everyday tasks: pouring, drinking and building at a kitchen table.
import type { OpenScene } from "../../scene";
import { Breakfast } from "./breakfast";
import { kitchen } from "./kitchen";

export const open: OpenScene = (side) => new Breakfast(side, kitchen());
