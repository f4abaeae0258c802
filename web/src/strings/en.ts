// Everything the browser says, in English; a file per page in en/. zh/ has the same keys; a missing one does not compile.
import { frame } from "./en/frame";
import { gameReach } from "./en/game-reach";
import { live } from "./en/live";
import { patient } from "./en/patient";
import { play } from "./en/play";
import { session } from "./en/session";

export const en = { ...play, ...live, ...session, ...patient, ...frame, ...gameReach } as const;
