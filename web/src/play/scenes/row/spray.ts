// Where a blade enters the water: rings that widen, and drops that fly while it pulls. Neither where motion disturbs.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  Mesh,
  MeshBasicMaterial,
  Points,
  PointsMaterial,
  RingGeometry,
  type Vector3,
} from "three";
import { glowTexture } from "../../textures";
import { WATER_Y } from "./water";

const DROPS = 40;
const DROP_LIFE_S = 0.6;
const DROPS_PER_S = 26;
const RINGS = 6;
const RING_LIFE_S = 1.6;
const GRAVITY_M_S2 = 3;
const UNDER_WATER_Y = -9;

interface Drop {
  age_s: number;
  readonly from: [number, number, number];
  readonly speed: [number, number, number];
}

interface Widening {
  age_s: number;
  readonly mesh: Mesh<RingGeometry, MeshBasicMaterial>;
}

export class Spray {
  readonly group = new Group();
  private readonly places = new BufferAttribute(new Float32Array(3 * DROPS), 3);
  private readonly drops: Drop[] = Array.from({ length: DROPS }, () => ({
    age_s: DROP_LIFE_S,
    from: [0, UNDER_WATER_Y, 0],
    speed: [0, 0, 0],
  }));
  private readonly rings: readonly Widening[] = Array.from({ length: RINGS }, () => ({
    age_s: RING_LIFE_S,
    mesh: ring(),
  }));
  private next = 0;
  private nextRing = 0;
  private owed = 0;

  constructor() {
    const geometry = new BufferGeometry().setAttribute("position", this.places);
    const material = new PointsMaterial({ map: glowTexture(), color: new Color("#f2fffb"), size: 0.045 });
    material.transparent = true;
    material.depthWrite = false;
    const points = new Points(geometry, material);
    points.frustumCulled = false;
    this.group.add(points, ...this.rings.map((one) => one.mesh));
  }

  /** A blade enters at `place`. */
  enter(place: Vector3): void {
    const one = this.rings[this.nextRing++ % RINGS];
    if (!one) return;
    one.age_s = 0;
    one.mesh.position.set(place.x, WATER_Y + 0.008, place.z);
  }

  /** A blade pulls at `place` for `dt_s`. */
  pull(place: Vector3, dt_s: number): void {
    this.owed += DROPS_PER_S * dt_s;
    for (; this.owed >= 1; this.owed--) {
      const i = this.next++ % DROPS;
      const around = this.next * 2.39996;
      const speed: [number, number, number] = [
        0.35 * Math.cos(around),
        0.7 + 0.4 * ((i * 0.618) % 1),
        0.35 * Math.sin(around),
      ];
      this.drops[i] = { age_s: 0, from: [place.x, WATER_Y, place.z], speed };
    }
  }

  /** `drift_m`: how far the water has passed the boat since the frame before. */
  animate(dt_s: number, drift_m: number): void {
    this.drops.forEach((drop, i) => {
      drop.age_s += dt_s;
      this.putDrop(i, drop);
    });
    this.places.needsUpdate = true;
    for (const one of this.rings) {
      one.age_s += dt_s;
      widen(one, drift_m);
    }
  }

  private putDrop(i: number, { age_s: t, from, speed }: Drop): void {
    if (t >= DROP_LIFE_S) {
      this.places.setXYZ(i, 0, UNDER_WATER_Y, 0);
      return;
    }
    const y = from[1] + speed[1] * t - 0.5 * GRAVITY_M_S2 * t * t;
    this.places.setXYZ(i, from[0] + speed[0] * t, y, from[2] + speed[2] * t);
  }
}

function widen({ age_s, mesh }: Widening, drift_m: number): void {
  const share = Math.min(1, age_s / RING_LIFE_S);
  mesh.visible = share < 1;
  mesh.position.z += drift_m;
  mesh.scale.setScalar(0.06 + 0.5 * share);
  mesh.material.opacity = 0.7 * (1 - share) ** 1.5;
}

function ring(): Mesh<RingGeometry, MeshBasicMaterial> {
  const geometry = new RingGeometry(0.86, 1, 32);
  geometry.rotateX(-Math.PI / 2);
  const material = new MeshBasicMaterial({ color: new Color("#f2fffb"), transparent: true, depthWrite: false });
  return new Mesh(geometry, material);
}
