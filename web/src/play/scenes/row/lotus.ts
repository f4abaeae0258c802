// Lotus along the boat's course: buds until a stroke succeeds, then the next two open and stay open as they drift by.
import {
  BufferAttribute,
  type BufferGeometry,
  CircleGeometry,
  Color,
  DoubleSide,
  Group,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  PlaneGeometry,
  Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { WATER_Y } from "./water";

const COUNT = 16;
const EVERY_M = 1.25;
/** The nearest is this far behind the eyes when it is taken away. */
const BEHIND_M = 1.2;
const NEAREST_M = 2.2;
const FARTHEST_M = 8;
const OPENS_S = 0.9;
const SIZE_M = 0.26;
const PETALS = [
  { count: 8, lean: 1.15, length: 1, color: "#f48fb4" },
  { count: 6, lean: 0.75, length: 0.9, color: "#fbb9d0" },
  { count: 4, lean: 0.35, length: 0.75, color: "#ffe6ef" },
] as const;

export class Lotus {
  readonly group = new Group();
  private readonly flowers: InstancedMesh;
  private readonly pads: InstancedMesh;
  /** How long each has been opening, by its number along the course. */
  private readonly open_s = new Map<number, number>();
  private gone_m = 0;

  constructor() {
    const paint = () => new MeshBasicMaterial({ vertexColors: true, side: DoubleSide });
    this.flowers = new InstancedMesh(flower(), paint(), COUNT);
    this.pads = new InstancedMesh(pads(), paint(), COUNT);
    for (const one of [this.flowers, this.pads]) {
      one.frustumCulled = false;
      this.group.add(one);
    }
  }

  /** Opens the next two buds ahead; says where they are. */
  open(): Vector3[] {
    const first = this.firstNumber();
    const buds = Array.from({ length: COUNT }, (_, i) => first + i).filter((number) => {
      const away_m = -this.placeOf(number).z;
      return !this.open_s.has(number) && away_m > NEAREST_M && away_m < FARTHEST_M;
    });
    const next = buds.slice(0, 2);
    for (const number of next) this.open_s.set(number, 0);
    return next.map((number) => this.placeOf(number));
  }

  /** The boat has gone so far. */
  animate(dt_s: number, gone_m: number, still: boolean): void {
    this.gone_m = gone_m;
    const first = this.firstNumber();
    for (const [number, age_s] of this.open_s) {
      if (number < first) this.open_s.delete(number);
      else this.open_s.set(number, still ? OPENS_S : age_s + dt_s);
    }
    for (let i = 0; i < COUNT; i++) this.put(i, first + i);
    this.flowers.instanceMatrix.needsUpdate = true;
    this.pads.instanceMatrix.needsUpdate = true;
  }

  private put(i: number, number: number): void {
    const place = this.placeOf(number);
    const share = Math.min(1, (this.open_s.get(number) ?? 0) / OPENS_S);
    const eased = share * share * (3 - 2 * share);
    const across = SIZE_M * (0.42 + 0.58 * eased);
    const turned = new Matrix4().makeRotationY(number * 1.9).setPosition(place);
    const size = new Matrix4().makeScale(across, SIZE_M * (0.85 + 0.15 * eased), across);
    this.flowers.setMatrixAt(i, turned.clone().multiply(size));
    this.pads.setMatrixAt(i, turned);
  }

  private firstNumber(): number {
    return Math.ceil((this.gone_m - BEHIND_M) / EVERY_M);
  }

  /** By turns on the left and on the right, at uneven distances from the boat. */
  private placeOf(number: number): Vector3 {
    const side = number % 2 === 0 ? 1 : -1;
    const x = side * (1.25 + 1.3 * Math.abs(Math.sin(number * 2.4)));
    return new Vector3(x, WATER_Y + 0.02, this.gone_m - number * EVERY_M);
  }
}

/** Petals in three wreaths, standing in the unit height. */
function flower(): BufferGeometry {
  return mergeGeometries(
    PETALS.flatMap(({ count, lean, length, color }) =>
      Array.from({ length: count }, (_, i) => petal((i / count) * 2 * Math.PI + lean, lean, length, new Color(color))),
    ),
  );
}

function petal(turn_rad: number, lean_rad: number, length: number, color: Color): BufferGeometry {
  const geometry = new PlaneGeometry(0.5, length, 2, 2);
  const positions = geometry.getAttribute("position");
  for (let i = 0; i < positions.count; i++) {
    const up = positions.getY(i) / length + 0.5;
    const width = Math.sin(Math.PI * Math.min(1, 0.18 + 0.82 * up)) ** 0.8;
    positions.setX(i, positions.getX(i) * width);
    positions.setZ(i, 0.18 * up * up);
    positions.setY(i, up * length);
  }
  geometry.rotateX(lean_rad);
  geometry.rotateY(turn_rad);
  return tinted(geometry, (y) => color.clone().multiplyScalar(0.8 + 0.25 * Math.min(1, Math.max(0, y / length))));
}

/** Two round leaves on the water beside each flower. */
function pads(): BufferGeometry {
  const leaf = (radius_m: number, x: number, z: number, color: string) => {
    const geometry = new CircleGeometry(radius_m, 18, 0.25, 2 * Math.PI - 0.5);
    geometry.rotateX(-Math.PI / 2);
    geometry.translate(x, -0.012, z);
    return tinted(geometry, () => new Color(color));
  };
  return mergeGeometries([leaf(0.3, 0.12, 0.1, "#4f9a4c"), leaf(0.22, -0.3, -0.16, "#5fae58")]);
}

function tinted(geometry: BufferGeometry, colorAt: (y: number) => Color): BufferGeometry {
  const positions = geometry.getAttribute("position");
  const colors = new Float32Array(3 * positions.count);
  for (let i = 0; i < positions.count; i++) colorAt(positions.getY(i)).toArray(colors, 3 * i);
  geometry.setAttribute("color", new BufferAttribute(colors, 3));
  geometry.deleteAttribute("uv");
  geometry.deleteAttribute("normal");
  return geometry;
}
