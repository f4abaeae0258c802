// 浏览器界面的全部中文文字，每个页面一个文件（zh/）；键与 en/ 相同，缺一个就无法编译。

import type { Key } from "./index";
import { frame } from "./zh/frame";
import { gameReach } from "./zh/game-reach";
import { live } from "./zh/live";
import { patient } from "./zh/patient";
import { play } from "./zh/play";
import { session } from "./zh/session";

export const zh: Record<Key, string> = { ...play, ...live, ...session, ...patient, ...frame, ...gameReach };
