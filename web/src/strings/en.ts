// Everything the browser says, in English; a file per page in en/. zh/ has the same keys; a missing one does not compile.
import { frame } from "./en/frame";
import { gameCatch } from "./en/game-catch";
import { gameEveryday } from "./en/game-everyday";
import { gameReach } from "./en/game-reach";
import { gameRow } from "./en/game-row";
import { gameTrace } from "./en/game-trace";
import { gameWipe } from "./en/game-wipe";
import { live } from "./en/live";
import { metrics } from "./en/metrics";
import { patient } from "./en/patient";
import { plan } from "./en/plan";
import { play } from "./en/play";
import { progress } from "./en/progress";
import { replay } from "./en/replay";
import { report } from "./en/report";
import { scores } from "./en/scores";
import { session } from "./en/session";
import { today } from "./en/today";
import { wizard } from "./en/wizard";

export const en = {
  ...play,
  ...live,
  ...session,
  ...metrics,
  ...patient,
  ...frame,
  ...gameReach,
  ...gameTrace,
  ...gameRow,
  ...gameCatch,
  ...gameEveryday,
  ...gameWipe,
  ...wizard,
  ...today,
  ...scores,
  ...replay,
  ...plan,
  ...report,
  ...progress,
} as const;
