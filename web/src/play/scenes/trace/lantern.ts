// The lantern that is led: it floats on a thread just above the hand, where the arm does not hide it; round the thread's
// end, which is what counts, stands a ring as wide as the tube.
import {
  Color,
  CylinderGeometry,
  GreaterDepth,
  Group,
  LatheGeometry,
  Mesh,
  MeshBasicMaterial,
  Sprite,
  SpriteMaterial,
  Vector2,
  Vector3,
} from "three";
import type { ThingView } from "../../changes";
import { DwellRing, gapTo } from "../../dwell-ring";
import { paint } from "../../paint";
import type { Moment } from "../../scene";
import { glowTexture } from "../../textures";

/** Half-outline of the paper from the bottom to the top as (radius, height) in metres. */
const OUTLINE = [
  [0.014, -0.036],
  [0.03, -0.03],
  [0.039, -0.012],
  [0.04, 0.006],
  [0.034, 0.024],
  [0.018, 0.035],
] as const;
const RIBS = 10;
const ABOVE_M = 0.085;
const FOLLOWING_PER_S = 16;
const SWING_RAD_PER_M_S = 0.9;
const LARGEST_SWING_RAD = 0.5;
const BRIGHT = new Color("#ffe08a");
const WARM = new Color("#f08a24");

export class Lantern {
  readonly group = new Group();
  /** How much of the path is done, 0..1, as it is drawn. */
  share: number;
  private readonly floating = new Group();
  private readonly rings = new DwellRing();
  private readonly velocity = new Vector3();

  constructor(view: ThingView) {
    this.share = view.progress;
    const body = paperLantern();
    body.position.y = ABOVE_M;
    this.floating.add(body, thread());
    this.rings.group.scale.setScalar(view.radius_m);
    this.group.add(this.floating, this.rings.group);
    this.group.position.set(...view.position);
  }

  animate({ dt_s, hand, camera, still }: Moment, view: ThingView): void {
    const following = Math.min(1, dt_s * FOLLOWING_PER_S);
    const before = this.group.position.clone();
    this.group.position.lerp(new Vector3(...view.position), following);
    this.share += (view.progress - this.share) * following;
    const led = view.state === "led";
    this.rings.animate(dt_s, led ? 0 : gapTo(hand, this.group.position, view.radius_m), view.progress, camera);
    if (!still && dt_s > 0) this.swing(this.group.position.clone().sub(before).divideScalar(dt_s), dt_s);
  }

  /** What floats stays a little behind. */
  private swing(velocity_m_s: Vector3, dt_s: number): void {
    this.velocity.lerp(velocity_m_s, Math.min(1, dt_s * 5));
    const limited = (speed: number) =>
      Math.max(-LARGEST_SWING_RAD, Math.min(LARGEST_SWING_RAD, SWING_RAD_PER_M_S * speed));
    this.floating.rotation.set(-limited(this.velocity.z), 0, limited(this.velocity.x));
  }
}

/** The paper with its glow and what shows through an arm before it; its middle is the origin. */
function paperLantern(): Group {
  const shape = paint(
    new LatheGeometry(
      OUTLINE.map(([radius, height]) => new Vector2(radius, height)),
      2 * RIBS,
    ),
    ({ x, y, z }) => {
      const rib = Math.round((Math.atan2(z, x) / Math.PI) * RIBS) % 2 === 0 ? 1 : 0.9;
      return WARM.clone()
        .lerp(BRIGHT, 1 - Math.abs(y) / 0.036)
        .multiplyScalar(rib);
    },
  );
  const paper = new Mesh(shape, new MeshBasicMaterial({ vertexColors: true }));
  const through = new MeshBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.45, depthWrite: false });
  through.depthFunc = GreaterDepth;
  const glow = new Sprite(
    new SpriteMaterial({ map: glowTexture(), color: new Color("#ffd98a"), depthWrite: false, opacity: 0.6 }),
  );
  glow.scale.setScalar(0.26);
  glow.renderOrder = -1;
  const group = new Group();
  group.add(glow, paper, new Mesh(shape, through), rim(0.036, 0.018), rim(-0.037, 0.014));
  return group;
}

function rim(y_m: number, radius_m: number): Mesh {
  const mesh = new Mesh(
    new CylinderGeometry(radius_m, radius_m, 0.006, 14),
    new MeshBasicMaterial({ color: new Color("#5b2e14") }),
  );
  mesh.position.y = y_m;
  return mesh;
}

function thread(): Mesh {
  const mesh = new Mesh(
    new CylinderGeometry(0.0015, 0.0015, ABOVE_M, 5),
    new MeshBasicMaterial({ color: new Color("#5b2e14") }),
  );
  mesh.position.y = ABOVE_M / 2;
  return mesh;
}
