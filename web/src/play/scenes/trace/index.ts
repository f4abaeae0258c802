// Tracing: a paper lantern led along a path of light over a lake at dusk.
import type { OpenScene } from "../../scene";
import { Dusk } from "./dusk";
import { lake } from "./lake";

export const open: OpenScene = () => new Dusk(lake());
