// Do the sensors agree where the patient is? They find it out by themselves while the patient moves.
import type { SensorView } from "../../api/types";
import { t } from "../../strings";
import { thousandths } from "../format";
import { type Facts, farApart, LARGE_RESIDUAL_M, sending, standingOf } from "./steps";

export function AlignmentStep({ facts }: { facts: Facts }) {
  const sensors = sending(facts.sensors);
  const { mark, words, values } = standingOf("alignment", facts);
  return (
    <>
      <p class={mark === "done" ? "wizard-fine" : ""}>
        {mark === "done" ? "✓ " : "… "}
        {t(words, values)}
      </p>
      {mark === "busy" && sensors.length > 0 && <p>{t("wizard.alignment.do")}</p>}
      {mark === "look" && (
        <p class="notice">
          <span aria-hidden="true">⚠</span>
          {t("wizard.alignment.large.do", {
            sensors: farApart(sensors)
              .map(({ sensor }) => sensor)
              .join(", "),
          })}
        </p>
      )}
      <ul class="wizard-agreement">
        {sensors.map((sensor) => (
          <Agreement key={sensor.sensor} sensor={sensor} />
        ))}
      </ul>
    </>
  );
}

/** How far a sensor's body is from the reference's, against what is too far. */
function Agreement({ sensor }: { sensor: SensorView }) {
  return (
    <li>
      <strong>{sensor.sensor}</strong>
      <span>{wordsOf(sensor)}</span>
      {sensor.aligned && !sensor.is_reference && (
        <meter min={0} max={2 * LARGE_RESIDUAL_M} high={LARGE_RESIDUAL_M} value={sensor.residual_m ?? 0}>
          {thousandths(sensor.residual_m)} mm
        </meter>
      )}
    </li>
  );
}

function wordsOf({ is_reference, aligned, residual_m }: SensorView): string {
  if (is_reference) return t("wizard.alignment.reference");
  return aligned ? t("wizard.alignment.apart", { mm: thousandths(residual_m) }) : t("wizard.alignment.learning");
}
