// One thing on the table: stands, glows when it is wanted, goes with the hand, tilts to pour and to drink.
import {
  CircleGeometry,
  Color,
  DoubleSide,
  GreaterDepth,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Vector3,
} from "three";
import type { ThingView } from "../../changes";
import type { Moment } from "../../scene";
import { gripOf, shapeOf, sipOf } from "./shapes";

/** How fast a thing follows where it should be, and how it should be tilted. */
const FOLLOWING_PER_S = 9;
const POUR_RAD = 1.05;
const SIP_RAD = 0.25;
const DRINK_RAD = 1.15;
const DRINK_COLOR = "#f4901e";
/** The drink's surface, from an empty cup to a full one, and how wide it is there. */
const BOTTOM_M = -0.05;
const TOP_M = 0.016;
const DRINK_WIDE_M = 0.0335;
const WIDENS = 0.1;
/** A wanted thing swells and shrinks this much. */
const BREATHES = 0.05;
/** About 0.1 m at arm's length, in the smallest steps of the depth buffer. */
const OWN_DEPTH = 150_000;

export class Prop {
  readonly group = new Group();
  readonly kind: string;
  private readonly solid = new Group();
  private readonly drink: Mesh | null;
  private readonly wished = new Vector3();
  private readonly grip: Vector3;
  private readonly sip: Vector3;
  private tilt = 0;
  private full = 0;
  private age_s = 0;

  constructor(
    private view: ThingView,
    private readonly inward: number,
  ) {
    this.kind = view.kind;
    const shape = shapeOf(view.kind, inward);
    const paint = new MeshLambertMaterial({ vertexColors: true, side: DoubleSide });
    this.drink = view.kind === "cup" ? surface() : null;
    this.solid.add(new Mesh(shape, paint), glimpse(shape), ...(this.drink ? [this.drink] : []));
    this.grip = gripOf(inward);
    this.sip = sipOf(inward);
    this.solid.position.copy(this.grip);
    this.group.add(this.solid);
    this.group.position.set(...view.position);
  }

  get isHeld(): boolean {
    return this.view.state === "held";
  }

  show(view: ThingView): void {
    this.view = view;
  }

  /** Draws the next instant; `verb` is what is done with it there, "" = nothing. */
  animate({ dt_s, hand, still }: Moment, verb: string): void {
    this.age_s += dt_s;
    const share = still ? 1 : Math.min(1, dt_s * FOLLOWING_PER_S);
    this.place(hand, share);
    this.tilt += (this.tiltFor(verb) - this.tilt) * share;
    this.solid.position.lerp(this.isHeld && verb === "drink" ? this.sip : this.grip, share);
    this.lean();
    const breath = this.view.state === "wanted" && !still ? BREATHES * Math.sin(this.age_s * 4) : 0;
    this.group.scale.setScalar(1 + breath);
    this.fill(share);
  }

  /** In the hand it is where the hand is drawn; elsewhere it glides to its place. */
  private place(hand: Vector3 | null, share: number): void {
    this.wished.set(...this.view.position);
    if (this.isHeld && hand) this.group.position.lerp(hand, Math.min(1, share * 3));
    else this.group.position.lerp(this.wished, share);
  }

  private tiltFor(verb: string): number {
    if (!this.isHeld) return 0;
    if (verb === "pour") return POUR_RAD;
    return verb === "drink" ? SIP_RAD + (DRINK_RAD - SIP_RAD) * (1 - this.view.progress) : 0;
  }

  /** The jug leans inward, the cup towards the mouth. */
  private lean(): void {
    if (this.kind === "jug") this.solid.rotation.z = -this.inward * this.tilt;
    else this.solid.rotation.x = this.tilt;
  }

  private fill(share: number): void {
    if (!this.drink) return;
    this.full += (this.view.progress - this.full) * share;
    this.drink.visible = this.full > 0.02;
    this.drink.position.y = BOTTOM_M + (TOP_M - BOTTOM_M) * this.full;
    this.drink.scale.setScalar(1 + WIDENS * this.full);
  }
}

/** The drink as it is seen from above. */
function surface(): Mesh {
  const paint = new MeshBasicMaterial({ color: new Color(DRINK_COLOR), side: DoubleSide });
  return new Mesh(new CircleGeometry(DRINK_WIDE_M, 24).rotateX(-Math.PI / 2), paint);
}

/** What shows through where the arm is before the thing. */
function glimpse(shape: Mesh["geometry"]): Mesh {
  const paint = new MeshBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.35, depthWrite: false });
  paint.depthFunc = GreaterDepth;
  // Brought so much nearer that it never shows through the thing itself.
  paint.polygonOffset = true;
  paint.polygonOffsetUnits = -OWN_DEPTH;
  return new Mesh(shape, paint);
}
