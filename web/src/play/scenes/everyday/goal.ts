// Where the hand is to stay now: rings that close and fill, and a pale likeness of the thing that is to come there.
import { type BufferGeometry, Color, Group, Mesh, MeshBasicMaterial, Vector3 } from "three";
import type { ThingView } from "../../changes";
import { DwellRing, gapTo } from "../../dwell-ring";
import type { Moment } from "../../scene";
import { gripOf, shapeOf, sipOf } from "./shapes";

/** The rings' middle lies between the hand and the thing. */
const TO_THING = 0.5;
const GHOST_OPACITY = 0.38;
/** How the likeness leans, as the thing will. */
const LEANS: Readonly<Record<string, number>> = { pour: 0.6, drink: 0.5 };

export class Goal {
  readonly group = new Group();
  private readonly rings = new DwellRing();
  private readonly place = new Vector3();
  private readonly ghosts = new Map<string, Mesh>();
  private readonly paint = new MeshBasicMaterial({
    color: new Color("#fffbe8"),
    transparent: true,
    opacity: GHOST_OPACITY,
    depthWrite: false,
  });
  private view: ThingView | null = null;

  constructor(private readonly inward: number) {
    this.rings.group.position.copy(gripOf(inward)).multiplyScalar(TO_THING);
    this.group.add(this.rings.group);
    this.group.visible = false;
  }

  get verb(): string {
    return this.view?.state ?? "";
  }

  /** True while the hand is where it is to stay. */
  isReached(hand: Vector3 | null): boolean {
    return this.view !== null && gapTo(hand, this.place, this.view.radius_m) === 0;
  }

  /** Shows the goal, if there is one, for a thing of `kind`. */
  show(view: ThingView | null, kind: string): void {
    this.view = view;
    this.group.visible = view !== null;
    if (!view) return;
    this.place.set(...view.position);
    this.group.position.copy(this.place);
    const shown = view.state === "take" ? null : this.ghostOf(kind);
    for (const ghost of this.ghosts.values()) ghost.visible = ghost === shown;
    shown?.position.copy(view.state === "drink" ? sipOf(this.inward) : gripOf(this.inward));
    if (shown) lean(shown, kind, LEANS[view.state] ?? 0, this.inward);
  }

  animate({ dt_s, hand, camera }: Moment): void {
    if (!this.view) return;
    this.rings.group.scale.setScalar(this.view.radius_m);
    this.rings.animate(dt_s, gapTo(hand, this.place, this.view.radius_m), this.view.progress, camera);
    this.paint.opacity = GHOST_OPACITY * (this.isReached(hand) ? 0.3 : 1);
  }

  private ghostOf(kind: string): Mesh {
    const known = this.ghosts.get(kind);
    if (known) return known;
    const ghost = new Mesh(plain(shapeOf(kind, this.inward)), this.paint);
    this.ghosts.set(kind, ghost);
    this.group.add(ghost);
    return ghost;
  }
}

/** The jug leans inward, the cup towards the eyes. */
function lean(ghost: Mesh, kind: string, tilt_rad: number, inward: number): void {
  ghost.rotation.set(kind === "cup" ? tilt_rad : 0, 0, kind === "jug" ? -inward * tilt_rad : 0);
}

function plain(shape: BufferGeometry): BufferGeometry {
  return shape.deleteAttribute("color");
}
