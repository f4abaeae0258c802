// Every sensor in a line, with all its figures behind it: on the live page the game needs the room.
import type { SensorView } from "../../api/types";
import { t } from "../../strings";
import { figure, sentence, thousandths } from "../format";
import { type Feed, useFromFeed } from "./feed";
import { JOINT_COUNT, NoSensor, stateOf, warningsOf } from "./sensors";
import "./sensor-lines.css";

export function SensorLines({ feed }: { feed: Feed }) {
  const sensors = useFromFeed(feed, 4, ({ newest }) => newest?.tick.sensors ?? []);
  const warnings = useFromFeed(feed, 2, ({ newest }) => newest?.tick.warnings ?? []);
  return (
    <section class="sensor-lines" aria-label={t("sensor.name")}>
      {sensors.length === 0 && <NoSensor />}
      {sensors.map((sensor) => (
        <Line key={sensor.sensor} sensor={sensor} />
      ))}
      {[...sensors.flatMap(warningsOf), ...warnings.map(sentence)].map((warning) => (
        <p key={warning} class="small caveat">
          ⚠ {warning}
        </p>
      ))}
    </section>
  );
}

function Line({ sensor }: { sensor: SensorView }) {
  return (
    <details data-testid="sensor-row" data-aligned={sensor.aligned}>
      <summary class="small">
        <strong>{sensor.sensor}</strong> {stateOf(sensor)}
      </summary>
      <dl class="small">
        {figuresOf(sensor).map(([name, value]) => (
          <div key={name}>
            <dt class="soft">{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
    </details>
  );
}

function figuresOf(sensor: SensorView): [string, string][] {
  return [
    [t("sensor.frames"), figure(sensor.frames_per_s, 1)],
    [t("sensor.latency"), thousandths(sensor.latency_s)],
    [t("sensor.joints"), `${sensor.joints_tracked}/${JOINT_COUNT}`],
    [t("sensor.clock"), thousandths(sensor.clock_offset_s)],
    [t("sensor.residual"), thousandths(sensor.residual_m)],
    [t("sensor.age"), figure(sensor.age_s, 1)],
  ];
}
