// Turned stands that carry the things to where the hand can take them. Their feet tell where on the table they are.
import {
  CircleGeometry,
  Color,
  CylinderGeometry,
  Group,
  InstancedMesh,
  LatheGeometry,
  Matrix4,
  MeshBasicMaterial,
  MeshLambertMaterial,
  Quaternion,
  Vector2,
  Vector3,
} from "three";
import { TABLE_Y } from "../../table";
import { FOOT_M } from "./shapes";

const MOST = 8;
const PLATE_M = 0.058;
const PLATE_THICK_M = 0.008;
const WOOD = "#d7a870";
const LIFT_M = 0.002;
const UPRIGHT = new Quaternion();
/** Half-outline of a column one metre high. */
const COLUMN: readonly (readonly [number, number])[] = [
  [0.04, 0],
  [0.038, 0.03],
  [0.016, 0.12],
  [0.012, 0.45],
  [0.017, 0.52],
  [0.012, 0.6],
  [0.014, 0.9],
  [0.03, 1],
];

/** A thing of a kind that rests, and where it is gripped. */
export interface Resting {
  readonly kind: string;
  readonly home: Vector3;
}

export class Stands {
  readonly group = new Group();
  private readonly plates: InstancedMesh;
  private readonly columns: InstancedMesh;
  private readonly shades: InstancedMesh;

  constructor() {
    const wood = new MeshLambertMaterial({ color: new Color(WOOD) });
    const shade = new MeshBasicMaterial({
      color: new Color("#0d0602"),
      transparent: true,
      opacity: 0.5,
      depthWrite: false,
    });
    const outline = COLUMN.map(([radius, height]) => new Vector2(radius, height));
    this.plates = new InstancedMesh(new CylinderGeometry(PLATE_M, PLATE_M * 0.92, PLATE_THICK_M, 20), wood, MOST);
    this.columns = new InstancedMesh(new LatheGeometry(outline, 10), wood, MOST);
    this.shades = new InstancedMesh(new CircleGeometry(PLATE_M * 1.1, 18).rotateX(-Math.PI / 2), shade, MOST);
    this.shades.renderOrder = -2;
    for (const part of [this.plates, this.columns, this.shades]) {
      part.frustumCulled = false;
      this.group.add(part);
    }
  }

  /** Puts a stand beneath everything that rests. */
  carry(things: readonly Resting[]): void {
    const carried = things.slice(0, MOST);
    carried.forEach((thing, i) => {
      this.put(i, thing);
    });
    for (const part of [this.plates, this.columns, this.shades]) {
      part.count = carried.length;
      part.instanceMatrix.needsUpdate = true;
    }
  }

  private put(i: number, { kind, home }: Resting): void {
    const top_m = home.y - (FOOT_M[kind] ?? 0);
    const height_m = Math.max(0.001, top_m - PLATE_THICK_M - TABLE_Y);
    this.plates.setMatrixAt(i, new Matrix4().setPosition(home.x, top_m - PLATE_THICK_M / 2, home.z));
    const foot = new Vector3(home.x, TABLE_Y, home.z);
    this.columns.setMatrixAt(i, new Matrix4().compose(foot, UPRIGHT, new Vector3(1, height_m, 1)));
    this.shades.setMatrixAt(i, new Matrix4().setPosition(home.x + 0.012, TABLE_Y + LIFT_M, home.z + 0.006));
  }
}
