// A person seen from behind, so that their left is on the left, with one arm marked.
import type { Side } from "../../api/types";

const LEFT_ARM = "M26 34 C18 44 16 58 14 74";
const RIGHT_ARM = "M54 34 C62 44 64 58 66 74";

export function ArmPicture({ side }: { side: Side }) {
  const marked = side === "left" ? LEFT_ARM : RIGHT_ARM;
  const plain = side === "left" ? RIGHT_ARM : LEFT_ARM;
  return (
    <svg viewBox="0 0 80 84" width="80" height="84" aria-hidden="true" fill="none" stroke="currentColor">
      <circle cx="40" cy="14" r="9" stroke-width="3" />
      <path d="M28 32 H52 L48 76 H32 Z" stroke-width="3" stroke-linejoin="round" />
      <path d={plain} stroke-width="3" stroke-linecap="round" />
      <path d={marked} stroke-width="11" stroke-linecap="round" />
    </svg>
  );
}
