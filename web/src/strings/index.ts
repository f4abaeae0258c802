// What the browser says, in the language the person chose; used by the dashboard and the patient's screen alike.
import { en } from "./en";
import { zh } from "./zh";

export type Key = keyof typeof en;
export type Language = "en" | "zh";

export const LANGUAGES: readonly { id: Language; name: string }[] = [
  { id: "en", name: "English" },
  { id: "zh", name: "中文" },
];

const TABLES: Record<Language, Record<Key, string>> = { en, zh };
const HTML_LANG: Record<Language, string> = { en: "en", zh: "zh-Hans" };
const REMEMBERED_AS = "mirrorlimb.language";

const listeners = new Set<() => void>();
let chosen: Language = firstLanguage();

function firstLanguage(): Language {
  if (typeof localStorage === "undefined") return "en";
  const remembered = localStorage.getItem(REMEMBERED_AS);
  if (remembered === "en" || remembered === "zh") return remembered;
  return navigator.language.toLowerCase().startsWith("zh") ? "zh" : "en";
}

function markDocument(): void {
  if (typeof document !== "undefined") document.documentElement.lang = HTML_LANG[chosen];
}

export function language(): Language {
  return chosen;
}

/** Changes the language of this window, remembers it, and tells who listens. */
export function setLanguage(next: Language): void {
  chosen = next;
  localStorage.setItem(REMEMBERED_AS, next);
  announce();
}

/** Calls `listener` after every change, also one made in another window; returns how to stop listening. */
export function onLanguage(listener: () => void): () => void {
  listeners.add(listener);
  return () => listeners.delete(listener);
}

/** The text of `key`, with each `{name}` replaced by the value of that name. */
export function t(key: Key, values: Record<string, string | number> = {}): string {
  return fill(TABLES[chosen][key], values);
}

/** True if `key` names a text: for keys that are put together from what the service says. */
export function isKey(key: string): key is Key {
  return Object.hasOwn(en, key);
}

export function fill(text: string, values: Record<string, string | number>): string {
  return text.replace(/\{(\w+)\}/g, (whole, name: string) => String(values[name] ?? whole));
}

function announce(): void {
  markDocument();
  for (const listener of listeners) listener();
}

markDocument();
if (typeof window !== "undefined") {
  window.addEventListener("storage", (event) => {
    if (event.key !== REMEMBERED_AS) return;
    chosen = firstLanguage();
    announce();
  });
}
