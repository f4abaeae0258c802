// One butterfly: two pairs of wings that open and close about a dark body, its head where it flies to.
import {
  CapsuleGeometry,
  Color,
  DoubleSide,
  Group,
  Mesh,
  MeshBasicMaterial,
  Sprite,
  SpriteMaterial,
  type Vector3,
} from "three";
import { glowTexture } from "../../textures";
import { wingGeometry } from "./wings";

const COLORS = ["#3d9bff", "#ff9a2e", "#ffe04a", "#c98bff"].map((color) => new Color(color));
const BODY = new Color("#1a1420");
/** So far it is tipped towards the eyes, or its wings would be seen edge on. */
const TIPPED_RAD = 0.75;
const BEATS_PER_S = 2.6;
const OPEN_RAD = 0.3;
const BEAT_RAD = 0.6;
/** Sitting, it opens and closes its wings slowly. */
const RESTING_BEATS_PER_S = 0.6;

export class Butterfly {
  readonly group = new Group();
  private readonly turning = new Group();
  private readonly right: Mesh;
  private readonly left: Mesh;
  private readonly glow: Sprite;
  private readonly wings: MeshBasicMaterial;
  private beat = 0;

  /** `number` says which of the colours. */
  constructor(number: number) {
    this.wings = new MeshBasicMaterial({
      vertexColors: true,
      color: colorOf(number),
      side: DoubleSide,
      transparent: true,
    });
    const geometry = wingGeometry();
    this.right = new Mesh(geometry, this.wings);
    this.left = new Mesh(geometry, this.wings);
    this.left.scale.x = -1;
    const body = new Mesh(new CapsuleGeometry(0.055, 0.7, 3, 8), new MeshBasicMaterial({ color: BODY }));
    body.rotation.x = Math.PI / 2;
    this.turning.add(this.right, this.left, body, feeler(1), feeler(-1));
    this.glow = new Sprite(
      new SpriteMaterial({ map: glowTexture(), color: new Color("#fffdf0"), depthWrite: false, opacity: 0.75 }),
    );
    this.glow.scale.setScalar(3.4);
    this.glow.renderOrder = -1;
    const tipped = new Group();
    tipped.rotation.x = TIPPED_RAD;
    tipped.add(this.turning);
    this.group.add(this.glow, tipped);
  }

  /** Beats its wings for `dt_s`, lively in the air, slowly when it sits; where motion disturbs they stay open. */
  flutter(dt_s: number, sits: boolean, still: boolean): void {
    this.beat += dt_s * 2 * Math.PI * (sits ? RESTING_BEATS_PER_S : BEATS_PER_S);
    const angle = still ? OPEN_RAD : OPEN_RAD + BEAT_RAD * (0.5 + 0.5 * Math.sin(this.beat));
    this.right.rotation.z = angle;
    this.left.rotation.z = -angle;
  }

  /** Turns the head to where it flies; hardly moving, it stays as it is. */
  head(velocity_m_s: Vector3, dt_s: number): void {
    if (Math.hypot(velocity_m_s.x, velocity_m_s.z) < 0.05) return;
    const wanted = Math.atan2(-velocity_m_s.x, -velocity_m_s.z);
    const off = Math.atan2(Math.sin(wanted - this.turning.rotation.y), Math.cos(wanted - this.turning.rotation.y));
    this.turning.rotation.y += off * Math.min(1, 4 * dt_s);
  }

  /** 1 = all there, 0 = gone. */
  fade(there: number): void {
    this.wings.opacity = there;
    this.glow.material.opacity = 0.75 * there;
  }
}

/** The colour of the butterfly of that number. */
export function colorOf(number: number): Color {
  return COLORS[Math.abs(number) % COLORS.length] ?? BODY;
}

function feeler(side: number): Mesh {
  const mesh = new Mesh(new CapsuleGeometry(0.014, 0.42, 2, 5), new MeshBasicMaterial({ color: BODY }));
  mesh.position.set(side * 0.1, 0.06, -0.55);
  mesh.rotation.set(-Math.PI / 2 + 0.35, 0, -side * 0.45);
  return mesh;
}
