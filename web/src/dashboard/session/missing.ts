// What still keeps a session from being opened, as far as this page can know it; the service decides.
import { otherSide, type Patient, type Side } from "../../api/types";
import type { Key } from "../../strings";

export function missingFor(
  patient: Pick<Patient, "healthy_side" | "limits_set_by">,
  confirmed: Side | null,
): readonly Key[] {
  const missing: Key[] = [];
  if (!patient.limits_set_by) missing.push("prepare.limits.missing");
  if (!confirmed) missing.push("prepare.side.missing");
  else if (confirmed !== otherSide(patient.healthy_side)) missing.push("prepare.side.wrong");
  return missing;
}
