// Wiping: a misted window that stands in the patient's reach, and a landscape behind it.
import type { OpenScene } from "../../scene";
import { evening } from "./evening";
import { MistedWindow } from "./misted-window";

export const open: OpenScene = () => new MistedWindow(evening());
