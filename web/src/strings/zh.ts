// 浏览器界面的全部中文文字；键与 en.ts 相同，缺一个就无法编译。
import type { Key } from "./index";

export const zh: Record<Key, string> = {
  "app.name": "mirrorlimb",
  "app.disclaimer": "科研软件，不是医疗器械。",
};
