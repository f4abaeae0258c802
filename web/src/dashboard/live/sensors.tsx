// Every sensor with what a therapist wants to know of it; where there is none, what to do.
import { readStation } from "../../api/client";
import type { SensorView } from "../../api/types";
import { t } from "../../strings";
import { figure, sentence, thousandths } from "../format";
import { useAsked } from "../hooks";
import { type Feed, useFromFeed } from "./feed";
import { isSilent } from "./silent";
import "./sensors.css";

export const JOINT_COUNT = 25;

export function Sensors({ feed }: { feed: Feed }) {
  const sensors = useFromFeed(feed, 4, ({ newest }) => newest?.tick.sensors ?? []);
  const warnings = useFromFeed(feed, 2, ({ newest }) => newest?.tick.warnings ?? []);
  return (
    <section class="card sensors">
      {sensors.length === 0 ? <NoSensor /> : <SensorTable sensors={sensors} />}
      {[...sensors.flatMap(warningsOf), ...warnings.map(sentence)].map((warning) => (
        <p key={warning} class="small caveat">
          ⚠ {warning}
        </p>
      ))}
    </section>
  );
}

export function warningsOf({ sensor, warnings }: SensorView): string[] {
  return warnings.map((warning) => `${sensor}: ${sentence(warning)}`);
}

function SensorTable({ sensors }: { sensors: readonly SensorView[] }) {
  return (
    <div class="table-scroll">
      <table>
        <thead>
          <tr>
            <th>{t("sensor.name")}</th>
            <th class="number">{t("sensor.frames")}</th>
            <th class="number">{t("sensor.latency")}</th>
            <th class="number">{t("sensor.joints")}</th>
            <th class="number">{t("sensor.clock")}</th>
            <th class="number">{t("sensor.residual")}</th>
            <th class="number">{t("sensor.age")}</th>
          </tr>
        </thead>
        <tbody>
          {sensors.map((sensor) => (
            <Row key={sensor.sensor} sensor={sensor} />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Row({ sensor }: { sensor: SensorView }) {
  return (
    <tr data-testid="sensor-row" data-aligned={sensor.aligned}>
      <td>
        <strong>{sensor.sensor}</strong>
        <div>{stateOf(sensor)}</div>
        <div class="soft">{sensor.dialect}</div>
      </td>
      <td class="number">{figure(sensor.frames_per_s, 1)}</td>
      <td class="number">{thousandths(sensor.latency_s)}</td>
      <td class="number">
        {sensor.joints_tracked}/{JOINT_COUNT}
      </td>
      <td class="number">{thousandths(sensor.clock_offset_s)}</td>
      <td class="number">{thousandths(sensor.residual_m)}</td>
      <td class="number">{figure(sensor.age_s, 1)}</td>
    </tr>
  );
}

export function stateOf(sensor: SensorView): string {
  if (isSilent(sensor)) return `✕ ${t("sensor.silent")}`;
  if (!sensor.aligned) return `… ${t("sensor.aligning")}`;
  return `✓ ${t(sensor.is_reference ? "sensor.reference" : "sensor.aligned")}`;
}

/** Where to send, and what to look at: nothing has come yet. */
export function NoSensor() {
  const station = useAsked(readStation, "station");
  const ports = Object.entries(station.value?.ports ?? {});
  return (
    <div>
      <h3>{t("sensor.none")}</h3>
      <p>{t("sensor.none.what")}</p>
      <p class="row small">
        {ports.map(([dialect, port]) => (
          <span key={dialect}>
            <strong>{port}</strong> {dialect}
          </span>
        ))}
      </p>
    </div>
  );
}
