// Finding a patient by a part of the name.
import type { PatientToday } from "../../api/types";

/** Those whose name has every word sought in it, in any order and case. */
export function matching(rows: readonly PatientToday[], sought: string): PatientToday[] {
  const words = plain(sought).split(/\s+/).filter(Boolean);
  return rows.filter(({ name }) => words.every((word) => plain(name).includes(word)));
}

/** Without accents, so that "Müller" is found by typing "muller". */
function plain(text: string): string {
  return text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
}
