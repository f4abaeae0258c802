// What the station and the service say in words of their own, in the language chosen. They speak English; a sentence
// that is not known here stays English, which is better than silence.
import { isKey, language, t } from "./index";
import { CHINESE } from "./zh/said";

/** As the station's own sentences begin; a full stop alone may belong to "Dr.". */
const NEXT_SENTENCE = /\.\s+(?=(?:A|No|Nobody|The)\s)/;

/** What the service says, one sentence or several, in the language chosen and without the last full stop. */
export function said(words: string): string {
  const plain = inDegrees(words).replace(/\.$/, "");
  return language() === "zh" ? inChinese(plain) : plain;
}

/** The station reckons in radians, people do not. */
function inDegrees(words: string): string {
  return words.replace(
    /(\d+(?:\.\d+)?) rad\b/g,
    (_, angle: string) => `${Math.round((Number(angle) * 180) / Math.PI)}°`,
  );
}

export function inChinese(plain: string): string {
  return plain.split(NEXT_SENTENCE).map(oneInChinese).join("；");
}

function oneInChinese(plain: string): string {
  for (const [pattern, chinese] of CHINESE) {
    const found = new RegExp(pattern, "i").exec(plain);
    if (found) return chinese.replace(/\{(\d)\}/g, (_, blank: string) => word(found[Number(blank)] ?? ""));
  }
  return plain;
}

/** What stood in a blank: a joint or a side by its own name, a further sentence, or itself. */
function word(blank: string): string {
  for (const key of [`joint.${blank}.short`, `side.${blank}`, `state.${blank}`]) {
    if (isKey(key)) return t(key);
  }
  return blank.includes(" ") ? inChinese(blank) : blank;
}
