// The quiet morning garden round the table: sky, hills, lawn, trees and flowers. Scenery only, nothing acts here.
import {
  AdditiveBlending,
  BackSide,
  BufferAttribute,
  type BufferGeometry,
  CircleGeometry,
  Color,
  CylinderGeometry,
  Group,
  IcosahedronGeometry,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  PlaneGeometry,
  SphereGeometry,
  Sprite,
  SpriteMaterial,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { glowTexture } from "./textures";

const LAWN_Y = -1.15;
const ZENITH = new Color("#6fb3e0");
const MIDDLE = new Color("#bfe0ee");
const HORIZON = new Color("#fdf0d5");
const HILLS: readonly { distance: number; height: number; waves: number; color: string }[] = [
  { distance: 46, height: 7.5, waves: 2.3, color: "#a9c8c9" },
  { distance: 36, height: 4.6, waves: 3.7, color: "#8fbaa2" },
  { distance: 26, height: 2.3, waves: 5.1, color: "#79ab79" },
];

type Tree = readonly [x: number, z: number, height: number, color: string];
const TREES: readonly Tree[] = [
  [-6.5, -13, 4.4, "#5d9650"],
  [-9.5, -15, 5.4, "#4f8a4a"],
  [7.5, -14, 4.8, "#5f9a4d"],
  [10.5, -12, 4.2, "#6aa554"],
  [3.4, -19, 4.2, "#699f5c"],
  [-2.6, -21, 3.8, "#74a968"],
];
const FLOWERS = ["#f6c945", "#f3f0ea", "#e0728f", "#b58ad6"] as const;

/** The whole scenery; `clouds` is apart because it may drift. */
export function garden(): { group: Group; clouds: Group } {
  const group = new Group();
  const clouds = cloudBank();
  group.add(sky(), sunGlow(), clouds, ...HILLS.map(hill), lawn(), plants());
  return { group, clouds };
}

function sky(): Mesh {
  const geometry = new SphereGeometry(80, 24, 16);
  paint(geometry, (_x, y) => {
    const up = Math.max(0, y / 80);
    return up < 0.22 ? HORIZON.clone().lerp(MIDDLE, up / 0.22) : MIDDLE.clone().lerp(ZENITH, (up - 0.22) / 0.78);
  });
  return new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: BackSide, depthWrite: false }));
}

function sunGlow(): Sprite {
  const material = new SpriteMaterial({
    map: glowTexture(),
    color: new Color("#ffe9b8"),
    blending: AdditiveBlending,
    depthWrite: false,
    opacity: 0.8,
  });
  const sprite = new Sprite(material);
  sprite.position.set(-22, 9, -60);
  sprite.scale.setScalar(34);
  return sprite;
}

function cloudBank(): Group {
  const group = new Group();
  const puffs = [
    [-14, 13, 9, 3.4],
    [-9, 12, 11, 3],
    [8, 15, 13, 3.8],
    [15, 13.5, 10, 3],
    [27, 11, 12, 3.2],
    [-30, 11, 12, 3.2],
  ] as const;
  for (const [x, y, width, height] of puffs) {
    const puff = new Sprite(new SpriteMaterial({ map: glowTexture(), opacity: 0.75, depthWrite: false }));
    puff.position.set(x, y, -66);
    puff.scale.set(width, height, 1);
    group.add(puff);
  }
  return group;
}

/** A ridge like cut paper: a bent strip whose upper edge rolls. */
function hill({ distance, height, waves, color }: (typeof HILLS)[number]): Mesh {
  const geometry = new PlaneGeometry(130, 1, 90, 1);
  const positions = geometry.getAttribute("position");
  for (let i = 0; i < positions.count; i++) {
    const x = positions.getX(i);
    const crest = height * (0.62 + 0.26 * Math.sin(x * 0.022 * waves + waves) + 0.12 * Math.sin(x * 0.09 * waves));
    positions.setXYZ(i, x, positions.getY(i) > 0 ? LAWN_Y + crest : LAWN_Y - 1, -distance);
  }
  return new Mesh(geometry, new MeshBasicMaterial({ color: new Color(color) }));
}

function lawn(): Mesh {
  const geometry = new CircleGeometry(60, 40, 0, Math.PI * 2);
  geometry.rotateX(-Math.PI / 2);
  paint(geometry, (x, _y, z) => new Color("#8fbf63").lerp(new Color("#a8c98a"), Math.hypot(x, z) > 1 ? 1 : 0));
  const mesh = new Mesh(geometry, new MeshLambertMaterial({ vertexColors: true }));
  mesh.position.y = LAWN_Y;
  return mesh;
}

/** Trees, hedge and flowers as one mesh: one draw call. */
function plants(): Mesh {
  const parts = [...TREES.flatMap(tree), ...hedge(), ...flowers()];
  return new Mesh(mergeGeometries(parts), new MeshLambertMaterial({ vertexColors: true, flatShading: true }));
}

function tree([x, z, height, color]: Tree): BufferGeometry[] {
  const trunk = new CylinderGeometry(height * 0.03, height * 0.05, height * 0.5, 7).toNonIndexed();
  trunk.translate(x, LAWN_Y + height * 0.25, z);
  const crowns = [
    [0, 0.62, 0.3],
    [-0.17, 0.5, 0.21],
    [0.18, 0.53, 0.22],
    [0.03, 0.82, 0.2],
  ].map(([dx = 0, dy = 0, radius = 0]) => {
    const crown = new IcosahedronGeometry(radius * height, 1);
    crown.translate(x + dx * height, LAWN_Y + dy * height, z + dx * 0.3 * height);
    return paint(crown, () => new Color(color));
  });
  return [paint(trunk, () => new Color("#8a6a4c")), ...crowns];
}

function hedge(): BufferGeometry[] {
  return Array.from({ length: 23 }, (_, i) => {
    const x = (i - 11) * 0.95;
    const bush = new IcosahedronGeometry(0.62 + 0.12 * Math.sin(i * 2.3), 1);
    bush.translate(x, LAWN_Y + 0.22, -8.5 - 0.4 * Math.cos(i * 1.7));
    return paint(bush, () => new Color("#6da457").offsetHSL(0, 0, 0.03 * Math.sin(i * 3.1)));
  });
}

function flowers(): BufferGeometry[] {
  return Array.from({ length: 90 }, (_, i) => {
    const bloom = new IcosahedronGeometry(0.055 + 0.02 * Math.sin(i * 1.3), 0);
    const x = ((i * 0.618) % 1) * 13 - 6.5;
    const z = -4.2 - ((i * 0.414) % 1) * 3.6;
    bloom.translate(x, LAWN_Y + 0.1 + 0.05 * Math.sin(i), z);
    return paint(bloom, () => new Color(FLOWERS[i % FLOWERS.length]));
  });
}

/** Gives every vertex a colour and drops texture coordinates, so that parts can be merged. */
function paint<G extends BufferGeometry>(geometry: G, colorAt: (x: number, y: number, z: number) => Color): G {
  const positions = geometry.getAttribute("position");
  const colors = new Float32Array(positions.count * 3);
  for (let i = 0; i < positions.count; i++) {
    colorAt(positions.getX(i), positions.getY(i), positions.getZ(i)).toArray(colors, 3 * i);
  }
  geometry.setAttribute("color", new BufferAttribute(colors, 3));
  geometry.deleteAttribute("uv");
  return geometry;
}
