// The butterflies that were caught: each sits on the hand for a moment, then joins the others over the valley.
import { Color, DoubleSide, Group, InstancedMesh, Matrix4, MeshBasicMaterial, Quaternion, Vector3 } from "three";
import type { Moment } from "../../scene";
import { colorOf } from "./butterfly";
import { ON_HAND_M } from "./flight";
import { wingGeometry } from "./wings";

export const MOST = 40;
const SITS_S = 0.9;
const FLIES_S = 3;
const ON_HAND_SIZE_M = 0.075;
const AFAR_SIZE_M = 0.15;
const RISES_M = 0.35;
const TIPPED = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), 0.8);
const AHEAD = new Vector3(0, 0, 1);
/** Steps that never fall into a visible pattern (golden ratio and √2 less their whole parts). */
const SPREAD_X = 0.618;
const SPREAD_Z = 0.414;

/** A butterfly that was just caught: where, and what number it had. */
export interface Caught {
  readonly place: Vector3;
  readonly number: number;
}

interface Friend {
  readonly from: Vector3;
  readonly home: Vector3;
  age_s: number;
}

export class Flock {
  readonly group = new Group();
  private friends: Friend[] = [];
  private readonly wings: readonly [InstancedMesh, InstancedMesh];

  constructor() {
    const geometry = wingGeometry();
    const material = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide });
    this.wings = [new InstancedMesh(geometry, material, MOST), new InstancedMesh(geometry, material, MOST)];
    for (const one of this.wings) {
      one.frustumCulled = false;
      one.count = 0;
      for (let i = 0; i < MOST; i++) one.setColorAt(i, new Color());
      this.group.add(one);
    }
  }

  /** Lets so many be there; a new one sets out from the hand that `caught` it. */
  hold(count: number, caught: Caught | null): void {
    const wanted = Math.min(count, MOST);
    if (this.friends.length > wanted) this.friends.length = wanted;
    while (this.friends.length < wanted) {
      const home = homeOf(this.friends.length);
      this.tint(this.friends.length, caught?.number ?? this.friends.length);
      this.friends.push({ from: caught?.place.clone() ?? home, home, age_s: caught ? 0 : SITS_S + FLIES_S });
    }
  }

  animate({ dt_s, now_s, hand, still }: Moment): void {
    this.friends.forEach((friend, i) => {
      friend.age_s += dt_s;
      const sits = friend.age_s < SITS_S;
      if (still && !sits) friend.age_s = SITS_S + FLIES_S;
      if (sits && hand) friend.from.lerp(new Vector3(hand.x, hand.y, hand.z), Math.min(1, 10 * dt_s));
      this.put(i, friend, sits, still ? 0 : now_s);
    });
    for (const one of this.wings) {
      one.count = this.friends.length;
      one.instanceMatrix.needsUpdate = true;
    }
  }

  private tint(i: number, number: number): void {
    for (const one of this.wings) {
      one.setColorAt(i, colorOf(number));
      if (one.instanceColor) one.instanceColor.needsUpdate = true;
    }
  }

  private put(i: number, friend: Friend, sits: boolean, now_s: number): void {
    const share = Math.min(1, Math.max(0, friend.age_s - SITS_S) / FLIES_S);
    const eased = share * share * (3 - 2 * share);
    const size_m = ON_HAND_SIZE_M + (AFAR_SIZE_M - ON_HAND_SIZE_M) * eased;
    const beat = 0.35 + 0.5 * (0.5 + 0.5 * Math.sin(now_s * (sits ? 4 : 9 + (i % 3)) + i));
    const place = new Matrix4().compose(placeOf(friend, i, eased, now_s), TIPPED, new Vector3().setScalar(size_m));
    this.wings.forEach((one, k) => {
      const side = k === 0 ? 1 : -1;
      const wing = new Matrix4().makeRotationAxis(AHEAD, side * beat).scale(new Vector3(side, 1, 1));
      one.setMatrixAt(i, place.clone().multiply(wing));
    });
  }
}

/** From the hand in a rising curve to its home, about which it then wanders. */
function placeOf({ from, home }: Friend, i: number, eased: number, now_s: number): Vector3 {
  const place = from.clone().lerp(home, eased);
  place.y += ON_HAND_M * (1 - eased) + RISES_M * Math.sin(Math.PI * eased);
  place.x += eased * 0.25 * Math.sin(now_s * 0.5 + i * 2.1);
  place.y += eased * 0.1 * Math.sin(now_s * 0.8 + i * 1.3);
  return place;
}

/** Over the blossom beyond the terrace, spread so that none hides another. */
export function homeOf(i: number): Vector3 {
  const away_m = 2.6 + 3.6 * ((0.2 + i * SPREAD_Z) % 1);
  const across = ((0.25 + i * SPREAD_X) % 1) * 2 - 1;
  return new Vector3(across * away_m * 0.95, 0.3 - 0.26 * away_m * (0.35 + 0.4 * ((i * 0.73) % 1)), -away_m);
}
