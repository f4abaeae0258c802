// The lake at dusk and the jetty from which it is seen: water, far shore, afterglow, reeds. Scenery only.
import {
  AdditiveBlending,
  BackSide,
  BoxGeometry,
  type BufferGeometry,
  CircleGeometry,
  Color,
  ConeGeometry,
  CylinderGeometry,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  RingGeometry,
  Scene,
  SphereGeometry,
  Sprite,
  SpriteMaterial,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { paint, shade } from "../../paint";
import { TABLE_Y } from "../../table";
import { glowTexture } from "../../textures";

export const WATER_Y = -1;
const SKY_M = 90;
const ZENITH = new Color("#4a5f9e");
const AFTERGLOW = new Color("#f7a66b");
const WATER_NEAR = new Color("#22466a");
const WATER_MIDDLE = new Color("#4a6f98");
const WATER_FAR = new Color("#d79a8c");
const GLOW_X_M = -9;
const PLANKS = 10;
const PLANK_M = 0.1;
const JETTY_WIDTH_M = 2.2;
const NEAR_EDGE_Z = -0.22;
const THICKNESS_M = 0.03;
const GAP_M = 0.007;
const PLANK = new Color("#7d6a5c");
const POST = new Color("#5a493e");
const SHORES = [
  { distance: 44, height: 3.2, waves: 0.31, color: "#2c3f5c" },
  { distance: 62, height: 7, waves: 0.13, color: "#5b6690" },
  { distance: 78, height: 11, waves: 0.08, color: "#8d83a6" },
] as const;
const RIPPLES = 150;
const PADS = 26;
const REEDS = 70;

export function lake(): Scene {
  const scene = new Scene();
  const plain = new MeshBasicMaterial({ vertexColors: true });
  const things = mergeGeometries([...jetty(), ...reeds(), ...pads()].map((one) => one.toNonIndexed()));
  scene.add(sky(), afterglow(), ...SHORES.map(shore), water(), ripples(), shine(), new Mesh(things, plain));
  return scene;
}

function sky(): Mesh {
  const geometry = paint(new SphereGeometry(SKY_M, 24, 32), ({ y }) =>
    AFTERGLOW.clone().lerp(ZENITH, Math.min(1, Math.max(0, y / SKY_M) * 2.6)),
  );
  return new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: BackSide, depthWrite: false }));
}

function afterglow(): Sprite {
  return glowing("#ffd9a0", 0.55, 34, GLOW_X_M * 2.2, 3, -70);
}

/** The glow's trail on the water, towards the eyes. */
function shine(): Mesh {
  const geometry = new PlaneGeometry(5, 40);
  geometry.rotateX(-Math.PI / 2);
  const material = new MeshBasicMaterial({ map: glowTexture(), color: new Color("#ffc98a"), transparent: true });
  material.opacity = 0.4;
  material.depthWrite = false;
  const mesh = new Mesh(geometry, material);
  mesh.position.set(GLOW_X_M * 0.7, WATER_Y + 0.01, -24);
  mesh.rotation.y = Math.atan2(GLOW_X_M * 0.7, -24);
  return mesh;
}

function glowing(color: string, opacity: number, size_m: number, x: number, y: number, z: number): Sprite {
  const material = new SpriteMaterial({ map: glowTexture(), color: new Color(color), opacity, depthWrite: false });
  material.blending = AdditiveBlending;
  const sprite = new Sprite(material);
  sprite.position.set(x, y, z);
  sprite.scale.setScalar(size_m);
  return sprite;
}

/** A wooded shore like cut paper: a strip whose upper edge rolls. */
function shore({ distance, height, waves, color }: (typeof SHORES)[number]): Mesh {
  const geometry = new PlaneGeometry(260, 1, 260, 1);
  const positions = geometry.getAttribute("position");
  for (let i = 0; i < positions.count; i++) {
    const x = positions.getX(i);
    const crest = 0.6 + 0.3 * Math.sin(x * waves * 0.4 + height) + 0.1 * Math.sin(x * waves * 2.7);
    positions.setXYZ(i, x, positions.getY(i) > 0 ? WATER_Y + height * crest : WATER_Y - 1, -distance);
  }
  return new Mesh(geometry, new MeshBasicMaterial({ color: new Color(color) }));
}

/** Dark and deep near by, the sky's colour far out. */
function water(): Mesh {
  const geometry = new RingGeometry(0.01, 80, 40, 40);
  geometry.rotateX(-Math.PI / 2);
  paint(geometry, ({ x, z }) => {
    const away = Math.hypot(x, z);
    return away < 14
      ? WATER_NEAR.clone().lerp(WATER_MIDDLE, away / 14)
      : WATER_MIDDLE.clone().lerp(WATER_FAR, Math.min(1, (away - 14) / 34));
  });
  const mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true }));
  mesh.position.y = WATER_Y;
  return mesh;
}

/** Short level streaks, finer with distance. */
function ripples(): Mesh {
  const streaks = Array.from({ length: RIPPLES }, (_, i) => {
    const far = (i * 0.414) % 1;
    const away = 2 + 26 * far * far;
    const streak = new PlaneGeometry(0.25 + 0.05 * away * ((i * 0.73) % 1), 0.012 + 0.004 * away);
    streak.rotateX(-Math.PI / 2);
    streak.translate((((i * 0.618) % 1) * 2 - 1) * (2 + away), WATER_Y + 0.005, -away);
    return streak;
  });
  const material = new MeshBasicMaterial({ color: new Color("#cfd9ee"), transparent: true, opacity: 0.16 });
  material.depthWrite = false;
  return new Mesh(mergeGeometries(streaks), material);
}

/** Planks that run crosswise, each a step of distance, on two beams with posts at the far corners. */
function jetty(): BufferGeometry[] {
  const planks = Array.from({ length: PLANKS }, (_, i) => {
    const plank = new BoxGeometry(JETTY_WIDTH_M, THICKNESS_M, PLANK_M - GAP_M);
    plank.translate(0.01 * Math.sin(i * 5.1), TABLE_Y - THICKNESS_M / 2, NEAR_EDGE_Z - (i + 0.5) * PLANK_M);
    return shade(plank, PLANK.clone().offsetHSL(0, 0, 0.022 * Math.sin(i * 2.3)));
  });
  const beams = [-0.8, 0, 0.8].map((x) => box(0.09, 0.07, PLANKS * PLANK_M, x, TABLE_Y - 0.07, NEAR_EDGE_Z - 0.5));
  const posts = [-1.02, 1.02].map((x) => {
    const post = new CylinderGeometry(0.045, 0.05, 0.8, 12);
    post.translate(x, TABLE_Y - 0.25, NEAR_EDGE_Z - PLANKS * PLANK_M + 0.03);
    return shade(post, POST);
  });
  return [...planks, ...beams, ...posts];
}

function box(width: number, height: number, depth: number, x: number, y: number, z: number): BufferGeometry {
  const geometry = new BoxGeometry(width, height, depth);
  geometry.translate(x, y, z);
  return shade(geometry, POST);
}

/** Lily pads to both sides of the jetty. */
function pads(): BufferGeometry[] {
  return Array.from({ length: PADS }, (_, i) => {
    const pad = new CircleGeometry(0.09 + 0.05 * ((i * 0.37) % 1), 14, 0.3, 2 * Math.PI - 0.5);
    pad.rotateX(-Math.PI / 2);
    const side = i % 2 === 0 ? 1 : -1;
    pad.translate(side * (1.5 + 1.5 * ((i * 0.618) % 1)), WATER_Y + 0.01, -1.3 - 1.9 * ((i * 0.414) % 1));
    return shade(pad, new Color("#3f6f5b").offsetHSL(0, 0, 0.03 * Math.sin(i)));
  });
}

/** Reeds that frame the view on the left and the right. */
function reeds(): BufferGeometry[] {
  return Array.from({ length: REEDS }, (_, i) => {
    const height = 0.7 + 0.7 * ((i * 0.53) % 1);
    const reed = new ConeGeometry(0.018, height, 4);
    reed.rotateZ(0.12 * Math.sin(i * 2.1));
    const side = i % 2 === 0 ? 1 : -1;
    const away = 3.2 + 2.6 * ((i * 0.414) % 1);
    reed.translate(side * away * (0.85 + 0.5 * ((i * 0.618) % 1)), WATER_Y + height / 2, -away);
    return shade(reed, new Color("#4c6a4a").offsetHSL(0, 0, 0.04 * Math.sin(i * 1.3)));
  });
}
