// An egg timer on the table: a pale disc whose coloured part shrinks with the time that is left.
import {
  CircleGeometry,
  Color,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  RingGeometry,
  SphereGeometry,
} from "three";
import type { Moment } from "../../scene";
import { TABLE_Y } from "../../table";

const STEPS = 60;
const EGG_M = 0.095;
const DIAL_M = 0.078;
const ASIDE_M = 0.56;
const AHEAD_M = 0.84;
/** The dial is turned up towards the eyes. */
const TURNED_UP_RAD = -0.55;
const SCARCE = 0.75;

export class EggTimer {
  readonly group = new Group();
  private readonly left: Mesh;
  private readonly plenty = new MeshBasicMaterial({ color: new Color("#2f8f5b") });
  private readonly scarce = new MeshBasicMaterial({ color: new Color("#d8632a") });
  private shown = 0;
  private gone = 0;

  constructor(inward: number) {
    const shell = new MeshLambertMaterial({ color: new Color("#f3ead7") });
    const egg = new Mesh(new SphereGeometry(EGG_M, 16, 10), shell);
    egg.scale.set(1, 1.15, 1);
    const dial = new Mesh(new CircleGeometry(DIAL_M, 40), new MeshBasicMaterial({ color: new Color("#fffdf6") }));
    const shape = new RingGeometry(0.012, DIAL_M * 0.92, STEPS, 1, Math.PI / 2, Math.PI * 2);
    shape.scale(-1, 1, 1);
    this.left = new Mesh(shape, this.plenty);
    this.plenty.side = this.scarce.side = 2;
    const face = new Group();
    face.add(dial, this.left);
    dial.position.z = EGG_M * 0.86;
    this.left.position.z = EGG_M * 0.86 + 0.002;
    face.rotation.x = TURNED_UP_RAD;
    this.group.add(egg, face);
    this.group.position.set(inward * ASIDE_M, TABLE_Y + EGG_M, -AHEAD_M);
  }

  /** `gone` is the share of the time that is over; null = nothing is timed. */
  show(gone: number | null): void {
    this.gone = gone ?? 0;
  }

  animate({ dt_s, still }: Moment): void {
    this.shown += (this.gone - this.shown) * (still ? 1 : Math.min(1, dt_s * 8));
    this.left.material = this.shown > SCARCE ? this.scarce : this.plenty;
    this.left.geometry.setDrawRange(6 * Math.round(STEPS * this.shown), Infinity);
  }
}
