// A small picture of one joint's range, for one arm: what zero is, which way is plus, how far it may go or went.
import type { Joint, Side } from "../../api/types";
import { t } from "../../strings";

/** How a joint's angle lies in its picture: SVG degrees (clockwise from the right) = `zero + sense · angle`. */
interface Look {
  pivot: readonly [number, number];
  zero: number;
  sense: 1 | -1;
  body: string;
}

const RADIUS = 42;

const LOOKS: Record<Joint, Look> = {
  // From above, face upwards: head and shoulders, arm to the right.
  plane: { pivot: [72, 66], zero: 0, sense: -1, body: "M24 66 H72 M36 66 a12 12 0 1 1 24 0 M45 53 l3 -6 l3 6" },
  // From behind: head, trunk, arm to the right.
  elevation: {
    pivot: [62, 38],
    zero: 90,
    sense: -1,
    body: "M44 38 H62 M44 38 V88 M36 20 a9 9 0 1 1 18 0 a9 9 0 1 1 -18 0",
  },
  // From above, upper arm hanging, elbow bent: the forearm points ahead at zero.
  rotation: { pivot: [80, 70], zero: -90, sense: -1, body: "M30 70 H80 M42 70 a12 12 0 1 1 24 0 M51 57 l3 -6 l3 6" },
  // From the side, looking right: upper arm hanging, forearm straight down at zero.
  elbow: {
    pivot: [50, 58],
    zero: 90,
    sense: -1,
    body: "M50 26 V58 M41 14 a9 9 0 1 1 18 0 a9 9 0 1 1 -18 0 M59 12 l5 3 l-5 3",
  },
};

/** One range in the picture; sessions are told apart by how far out and in which line they are drawn. */
export interface Sector {
  minDeg: number;
  maxDeg: number;
  look: "limit" | "first" | "last" | "best";
}

const RADII: Record<Sector["look"], number> = { limit: RADIUS, first: 26, last: 36, best: 46 };

interface Props {
  joint: Joint;
  side: Side;
  sectors: readonly Sector[];
}

export function RangePicture({ joint, side, sectors }: Props) {
  const look = LOOKS[joint];
  const [x, y] = look.pivot;
  const zero = pointAt(look, 0, RADIUS);
  return (
    <svg class="range-picture" viewBox="0 0 132 110" role="img" aria-label={t(`range.${joint}.picture`)}>
      <g transform={side === "left" ? "translate(132 0) scale(-1 1)" : undefined}>
        {sectors.map(
          (sector) =>
            sector.minDeg < sector.maxDeg && (
              <path key={sector.look} class={`sector-${sector.look}`} d={pathOf(look, sector)} />
            ),
        )}
        <path class="body-line" d={look.body} />
        <line class="body-zero" x1={x} y1={y} x2={zero[0]} y2={zero[1]} />
        <circle cx={x} cy={y} r="5" fill="var(--accent)" />
      </g>
    </svg>
  );
}

function pointAt(look: Look, angleDeg: number, radius: number): readonly [number, number] {
  const turn = ((look.zero + look.sense * angleDeg) * Math.PI) / 180;
  return [look.pivot[0] + radius * Math.cos(turn), look.pivot[1] + radius * Math.sin(turn)];
}

/** The path of the sector between its two angles; `minDeg < maxDeg`. */
function pathOf(look: Look, { minDeg, maxDeg, look: which }: Sector): string {
  const radius = RADII[which];
  const [x, y] = look.pivot;
  const from = pointAt(look, minDeg, radius).join(" ");
  const to = pointAt(look, maxDeg, radius).join(" ");
  const large = maxDeg - minDeg > 180 ? 1 : 0;
  const sweep = look.sense > 0 ? 1 : 0;
  return `M${x} ${y} L${from} A${radius} ${radius} 0 ${large} ${sweep} ${to} Z`;
}
