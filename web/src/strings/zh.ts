// 浏览器界面的全部中文文字，每个页面一个文件（zh/）；键与 en/ 相同，缺一个就无法编译。

import type { Key } from "./index";
import { frame } from "./zh/frame";
import { gameCatch } from "./zh/game-catch";
import { gameEveryday } from "./zh/game-everyday";
import { gameReach } from "./zh/game-reach";
import { gameRow } from "./zh/game-row";
import { gameTrace } from "./zh/game-trace";
import { gameWipe } from "./zh/game-wipe";
import { live } from "./zh/live";
import { metrics } from "./zh/metrics";
import { patient } from "./zh/patient";
import { plan } from "./zh/plan";
import { play } from "./zh/play";
import { progress } from "./zh/progress";
import { replay } from "./zh/replay";
import { report } from "./zh/report";
import { scores } from "./zh/scores";
import { session } from "./zh/session";
import { today } from "./zh/today";
import { wizard } from "./zh/wizard";

export const zh: Record<Key, string> = {
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
};
