// The room from above: sensors, and the people by their letters.
import type { SensorView } from "../../api/types";
import { t } from "../../strings";
import type { Person } from "./people";

/** Metres of floor about the sensors and the people that are always shown. */
const MARGIN_M = 0.5;
const LEAST_WIDTH_M = 3;

type Place = readonly [number, number];

export function FloorPlan({ people, sensors }: { people: readonly Person[]; sensors: readonly SensorView[] }) {
  const cameras = sensors.flatMap(({ sensor, position_in_room: at }) =>
    at ? [{ sensor, place: [at[0], at[2]] as const }] : [],
  );
  const placed = people.flatMap((person) => (person.place ? [{ person, place: person.place }] : []));
  if (placed.length === 0) return null;
  const box = boxAround([...cameras, ...placed].map(({ place }) => place));
  return (
    <svg class="who-plan" viewBox={box.join(" ")} role="img" aria-label={t("who.plan")}>
      {cameras.map(({ sensor, place: [x, z] }) => (
        <g key={sensor} transform={`translate(${x} ${-z})`}>
          <rect x="-0.16" y="-0.06" width="0.32" height="0.12" rx="0.03" class="who-camera" />
          <text y="0.26" class="who-name">
            {sensor}
          </text>
        </g>
      ))}
      {placed.map(({ person, place: [x, z] }) => (
        <g key={person.label} transform={`translate(${x} ${-z})`} class={person.isPatient ? "who-is-patient" : ""}>
          <circle r="0.24" class="who-dot" />
          <text y="0.1" class="who-mark">
            {person.label}
          </text>
        </g>
      ))}
    </svg>
  );
}

/** Left, top, width and height of a view that shows every place; the reference sensor looks up the page. */
function boxAround(places: readonly Place[]): [number, number, number, number] {
  const xs = places.map(([x]) => x);
  const ys = places.map(([, z]) => -z);
  const left = Math.min(...xs) - MARGIN_M;
  const top = Math.min(...ys) - MARGIN_M;
  const width = Math.max(...xs) + MARGIN_M - left;
  const height = Math.max(...ys) + MARGIN_M - top;
  const more = Math.max(0, LEAST_WIDTH_M - width);
  return [left - more / 2, top, width + more, height];
}
