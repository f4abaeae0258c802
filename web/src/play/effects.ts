// The small feast when a fruit is reached: petals that fly up and a ring that widens. No petals where motion disturbs.
import {
  BufferAttribute,
  BufferGeometry,
  type Camera,
  Color,
  Group,
  Mesh,
  MeshBasicMaterial,
  Points,
  PointsMaterial,
  RingGeometry,
  Vector3,
} from "three";
import { dispose } from "./dispose";
import { glowTexture } from "./textures";

const PETALS = 36;
const LIFE_S = 1.1;
const GRAVITY_M_S2 = 1.1;
const COLORS = ["#fff3b0", "#ffd23c", "#ff9f6b", "#ffffff"].map((color) => new Color(color));

/** One burst of petals and its ring; lives for `LIFE_S`. */
class Burst {
  readonly group = new Group();
  private age_s = 0;
  private readonly velocities = Array.from({ length: PETALS }, (_, i) => petalVelocity(i));
  private readonly positions = new BufferAttribute(new Float32Array(PETALS * 3), 3);
  private readonly petals: PointsMaterial;
  private readonly ring = new Mesh(
    new RingGeometry(0.9, 1, 48),
    new MeshBasicMaterial({ color: new Color("#fff6d0"), transparent: true, depthTest: false }),
  );

  constructor(at: Vector3, still: boolean) {
    this.petals = new PointsMaterial({
      map: glowTexture(),
      vertexColors: true,
      size: 0.045,
      transparent: true,
      depthWrite: false,
    });
    const geometry = new BufferGeometry().setAttribute("position", this.positions).setAttribute("color", petalColors());
    const points = new Points(geometry, this.petals);
    points.visible = !still;
    points.frustumCulled = false;
    this.ring.renderOrder = 9;
    this.group.position.copy(at);
    this.group.add(points, this.ring);
  }

  get over(): boolean {
    return this.age_s >= LIFE_S;
  }

  animate(dt_s: number, camera: Camera): void {
    this.age_s += dt_s;
    const t = this.age_s;
    const left = Math.max(0, 1 - t / LIFE_S);
    this.velocities.forEach((v, i) => {
      const drag = (1 - Math.exp(-2.2 * t)) / 2.2;
      this.positions.setXYZ(i, v.x * drag, v.y * drag - 0.5 * GRAVITY_M_S2 * t * t, v.z * drag);
    });
    this.positions.needsUpdate = true;
    this.petals.opacity = left;
    this.ring.quaternion.copy(camera.quaternion);
    this.ring.scale.setScalar(0.07 + 0.2 * (1 - left ** 3));
    this.ring.material.opacity = left ** 2;
  }
}

export class Effects {
  readonly group = new Group();
  private bursts: Burst[] = [];

  constructor(private readonly still: () => boolean) {}

  burst(at: Vector3): void {
    const burst = new Burst(at, this.still());
    this.bursts.push(burst);
    this.group.add(burst.group);
  }

  animate(dt_s: number, camera: Camera): void {
    for (const burst of this.bursts) burst.animate(dt_s, camera);
    for (const burst of this.bursts.filter((one) => one.over)) {
      this.group.remove(burst.group);
      dispose(burst.group);
    }
    this.bursts = this.bursts.filter((one) => !one.over);
  }
}

/** Evenly round about and upwards (golden angle), at two speeds. */
function petalVelocity(i: number): Vector3 {
  const around = i * 2.39996;
  const speed = 0.35 + 0.25 * ((i * 0.618) % 1);
  const up = 0.25 + 0.75 * ((i * 0.414) % 1);
  return new Vector3(Math.cos(around) * speed, up * 0.8, Math.sin(around) * speed);
}

function petalColors(): BufferAttribute {
  const colors = new Float32Array(PETALS * 3);
  for (let i = 0; i < PETALS; i++) COLORS[i % COLORS.length]?.toArray(colors, 3 * i);
  return new BufferAttribute(colors, 3);
}
