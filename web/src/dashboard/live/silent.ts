// Whether a sensor is heard.
import type { SensorView } from "../../api/types";

const SILENT_AFTER_S = 1;

export function isSilent({ age_s }: Pick<SensorView, "age_s">): boolean {
  return age_s > SILENT_AFTER_S;
}
