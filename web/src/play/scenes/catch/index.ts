// Catching: butterflies that settle on a hand which is there in time, over a valley in blossom.
import type { OpenScene } from "../../scene";
import { Terrace } from "./terrace";
import { valley } from "./valley";

export const open: OpenScene = () => new Terrace(valley());
