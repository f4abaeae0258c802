// What the limits have changed: the station says it joint by joint, people read it reason by reason.
import type { Joint } from "../../../api/types";
import { isKey, t } from "../../../strings";
import { sentence } from "../../format";

const OF_A_JOINT = /^(\w+): (.+)$/;

/** Whether the limits changed this joint's command just now; the station names the joint at the head of its words. */
export function isClamped(joint: Joint, clamped: readonly string[]): boolean {
  return clamped.some((words) => words.startsWith(`${joint}:`));
}

/** Each reason once, followed by its joints. */
export function byReason(clamped: readonly string[]): string[] {
  const joints = new Map<string, string[]>();
  for (const words of clamped) {
    const [, joint = "", reason = words] = OF_A_JOINT.exec(words) ?? [];
    joints.set(reason, [...(joints.get(reason) ?? []), ...(joint ? [nameOf(joint)] : [])]);
  }
  return [...joints].map(([reason, names]) => together(reason, names));
}

function together(reason: string, names: readonly string[]): string {
  const words = sentence(reason);
  return names.length === 0 ? words : t("exo.clamped.joints", { words, joints: names.join(", ") });
}

function nameOf(joint: string): string {
  const key = `joint.${joint}.short`;
  return isKey(key) ? t(key) : joint;
}
