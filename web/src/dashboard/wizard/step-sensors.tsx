// Are the sensors sending? Where one is not: what to switch on, and where to send.
import { t } from "../../strings";
import { NoSensor } from "../live/sensors";
import { type Facts, sending } from "./steps";

export function SensorsStep({ facts: { sensors } }: { facts: Facts }) {
  const now = sending(sensors);
  const silent = sensors.filter((sensor) => !now.includes(sensor)).map(({ sensor }) => sensor);
  if (now.length === 0 && silent.length === 0) return <None />;
  return (
    <>
      {now.length > 0 && <p class="wizard-fine">✓ {t("wizard.sensors.fine", { count: now.length })}</p>}
      {silent.length > 0 && (
        <p class="notice">
          <span aria-hidden="true">⚠</span>
          {t("wizard.sensors.silent.do", { sensors: silent.join(", ") })}
        </p>
      )}
      {now.length === 1 && <p class="soft">{t("wizard.sensors.one")}</p>}
    </>
  );
}

function None() {
  return (
    <>
      <div class="notice">
        <NoSensor />
      </div>
      <p>{t("wizard.sensors.meanwhile")}</p>
    </>
  );
}
