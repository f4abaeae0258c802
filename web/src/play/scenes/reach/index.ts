// Reaching and collecting: fruit over a garden table.
import type { OpenScene } from "../../scene";
import { garden } from "./garden";
import { Orchard } from "./orchard";

export const open: OpenScene = () => new Orchard(garden());
