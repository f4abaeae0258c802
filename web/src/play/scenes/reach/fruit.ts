// Three fruits to reach for, turned on a lathe; each has a shape of its own, so that colour is never the only sign.
import {
  CapsuleGeometry,
  Color,
  GreaterDepth,
  Group,
  LatheGeometry,
  Mesh,
  MeshBasicMaterial,
  MeshPhongMaterial,
  SphereGeometry,
  Vector2,
} from "three";

interface Kind {
  readonly color: string;
  /** Half-outline from the bottom to the top as (radius, height), in units of the fruit's radius. */
  readonly outline: readonly (readonly [number, number])[];
}

const APPLE: Kind = {
  color: "#d8322c",
  outline: [
    [0, -0.78],
    [0.22, -0.86],
    [0.52, -0.8],
    [0.84, -0.44],
    [1, 0.1],
    [0.93, 0.52],
    [0.66, 0.82],
    [0.34, 0.86],
    [0.12, 0.72],
    [0, 0.62],
  ],
};
const ORANGE: Kind = {
  color: "#f5840c",
  outline: [
    [0, -0.96],
    [0.3, -0.91],
    [0.68, -0.7],
    [0.94, -0.3],
    [1, 0.05],
    [0.9, 0.45],
    [0.65, 0.75],
    [0.3, 0.93],
    [0, 0.94],
  ],
};
const PEAR: Kind = {
  color: "#d9c21f",
  outline: [
    [0, -0.92],
    [0.4, -0.88],
    [0.8, -0.6],
    [0.92, -0.22],
    [0.78, 0.2],
    [0.52, 0.55],
    [0.4, 0.85],
    [0.3, 1.05],
    [0.12, 1.16],
    [0, 1.17],
  ],
};
const KINDS: readonly Kind[] = [ORANGE, APPLE, PEAR];
const STALK = new Color("#5a4022");
const LEAF = new Color("#3f8f3a");

/** A fruit of radius 1 about its middle; the kind follows the target's number. */
export function fruit(id: number): Group {
  const kind = KINDS[Math.abs(id) % KINDS.length] ?? ORANGE;
  const group = new Group();
  const top = kind.outline.at(-1)?.[1] ?? 1;
  group.add(...flesh(kind), stalk(top), leaf(top));
  return group;
}

function flesh({ color, outline }: Kind): Mesh[] {
  const skin = new Color(color);
  const shape = new LatheGeometry(
    outline.map(([radius, height]) => new Vector2(radius, height)),
    24,
  );
  const material = new MeshPhongMaterial({
    color: skin,
    emissive: skin.clone().multiplyScalar(0.28),
    specular: new Color("#665544"),
    shininess: 40,
  });
  return [new Mesh(shape, material), glimpse(shape, skin)];
}

/** What shows through where the arm is before the fruit, so that a fruit near the elbow is not lost. */
function glimpse(shape: LatheGeometry, color: Color): Mesh {
  const material = new MeshBasicMaterial({ color, transparent: true, opacity: 0.4, depthWrite: false });
  material.depthFunc = GreaterDepth;
  return new Mesh(shape, material);
}

function stalk(top: number): Mesh {
  const mesh = new Mesh(new CapsuleGeometry(0.05, 0.3, 2, 6), new MeshPhongMaterial({ color: STALK }));
  mesh.position.set(0.03, top + 0.14, 0);
  mesh.rotation.z = -0.25;
  return mesh;
}

function leaf(top: number): Mesh {
  const mesh = new Mesh(new SphereGeometry(1, 10, 6), new MeshPhongMaterial({ color: LEAF }));
  mesh.scale.set(0.36, 0.05, 0.17);
  mesh.position.set(0.36, top + 0.22, 0.02);
  mesh.rotation.z = 0.45;
  return mesh;
}
