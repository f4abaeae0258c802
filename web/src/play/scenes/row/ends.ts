// Where the hands are to go: a ring for each hand at the end that is next, and a small faint one at the end after it.
import { type Camera, CircleGeometry, Color, Group, Mesh, MeshBasicMaterial, RingGeometry, Vector3 } from "three";
import type { ThingView } from "../../changes";
import { DwellRing, gapTo } from "../../dwell-ring";
import type { Moment } from "../../scene";

const ABOVE_ALL = 8;

/** The rings of one hand. */
class HandEnds {
  readonly group = new Group();
  private readonly next = new DwellRing();
  /** Shrinks as the stroke's time passes. */
  private readonly time = new Mesh(new CircleGeometry(0.95, 32), paint("#ffffff", 0.32));
  private readonly after = new Mesh(new RingGeometry(0.6, 0.72, 28), paint("#ffffff", 0.6));
  private readonly facing = new Group();

  constructor(private readonly mirrored: boolean) {
    this.time.renderOrder = ABOVE_ALL - 1;
    this.facing.add(this.time);
    this.group.add(this.next.group, this.facing, this.after);
  }

  animate(dt_s: number, hand: Vector3 | null, things: readonly ThingView[], camera: Camera): void {
    const now = things.find((thing) => thing.state === "now");
    const later = things.find((thing) => thing.state === "later");
    this.group.visible = now !== undefined;
    this.after.visible = later !== undefined;
    if (now) this.show(now, dt_s, hand, camera);
    if (!later) return;
    this.after.position.copy(this.placeOf(later));
    this.after.scale.setScalar(later.radius_m);
    this.after.quaternion.copy(camera.quaternion);
  }

  private show(now: ThingView, dt_s: number, hand: Vector3 | null, camera: Camera): void {
    const place = this.placeOf(now);
    this.next.group.position.copy(place);
    this.next.group.scale.setScalar(now.radius_m);
    this.next.animate(dt_s, gapTo(hand, place, now.radius_m), 0, camera);
    this.facing.position.copy(place);
    this.facing.scale.setScalar(now.radius_m * (1 - now.progress));
    this.facing.quaternion.copy(camera.quaternion);
  }

  private placeOf({ position: [x, y, z] }: ThingView): Vector3 {
    return new Vector3(this.mirrored ? -x : x, y, z);
  }
}

export class Ends {
  readonly group = new Group();
  private readonly shown = new HandEnds(false);
  private readonly healthy = new HandEnds(true);

  constructor() {
    this.group.add(this.shown.group, this.healthy.group);
  }

  animate({ dt_s, hand, healthyHand, camera }: Moment, things: readonly ThingView[]): void {
    this.shown.animate(dt_s, hand, things, camera);
    this.healthy.animate(dt_s, healthyHand, things, camera);
  }
}

function paint(color: string, opacity: number): MeshBasicMaterial {
  return new MeshBasicMaterial({ color: new Color(color), transparent: true, opacity, depthTest: false });
}
