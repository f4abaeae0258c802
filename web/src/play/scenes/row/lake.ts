// The lake far out: steep hills in the morning mist and their reflections. Scenery only, so far away that it does not
// move as the boat goes; and the boat itself, which stays before the eyes.
import {
  AdditiveBlending,
  BackSide,
  type BufferGeometry,
  Color,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  RingGeometry,
  Scene,
  SphereGeometry,
  Sprite,
  SpriteMaterial,
} from "three";
import { paint } from "../../paint";
import { glowTexture } from "../../textures";
import { hull } from "./hull";
import { WATER_Y } from "./water";

const SKY_M = 95;
const ZENITH = new Color("#7fc4dc");
const HORIZON = new Color("#fff1d2");
const WATER_NEAR = new Color("#1f6f74");
const WATER_MIDDLE = new Color("#3f9a93");
const WATER_FAR = new Color("#dcebd0");
const STEPS = 420;
/** Far to near: distance, height, width of a hill, first hill's place, colour. */
const RANGES = [
  { distance: 84, height: 9, width: 22, from: 4, color: "#a9cfc6" },
  { distance: 66, height: 6.4, width: 17, from: 9, color: "#7fb5a6" },
  { distance: 50, height: 3.6, width: 13, from: 2, color: "#4f907e" },
] as const;
type Range = (typeof RANGES)[number];

export function lake(): Scene {
  const scene = new Scene();
  scene.add(sky(), water(), sun());
  RANGES.forEach((range, i) => {
    scene.add(reflection(range, i), hills(range, i));
  });
  scene.add(mist(), sunPath(), hull());
  return scene;
}

function sky(): Mesh {
  const geometry = paint(new SphereGeometry(SKY_M, 24, 32), ({ y }) =>
    HORIZON.clone().lerp(ZENITH, Math.min(1, Math.max(0, y / SKY_M) * 2.6)),
  );
  return behind(geometry, -30, BackSide);
}

function water(): Mesh {
  const geometry = new RingGeometry(0.01, 92, 48, 60);
  geometry.rotateX(-Math.PI / 2);
  paint(geometry, ({ x, z }) => {
    const away = Math.hypot(x, z);
    return away < 9
      ? WATER_NEAR.clone().lerp(WATER_MIDDLE, away / 9)
      : WATER_MIDDLE.clone().lerp(WATER_FAR, Math.min(1, (away - 9) / 50));
  });
  const mesh = behind(geometry, -20);
  mesh.position.y = WATER_Y;
  return mesh;
}

function hills(range: Range, i: number): Mesh {
  return behind(ridge(range, 1), -10 + i);
}

/** The hills upside down in the water, dim and below everything that floats. */
function reflection(range: Range, i: number): Mesh {
  const mesh = behind(ridge(range, -1), -18 + i, BackSide);
  const material = mesh.material as MeshBasicMaterial;
  material.transparent = true;
  material.opacity = 0.42;
  material.depthTest = false;
  return mesh;
}

/** Round-topped hills side by side, as limestone stands; paler at the foot. */
function ridge({ distance, height, width, from, color }: Range, up: 1 | -1): BufferGeometry {
  const geometry = new PlaneGeometry(300, 1, STEPS, 4);
  const positions = geometry.getAttribute("position");
  for (let i = 0; i < positions.count; i++) {
    const x = positions.getX(i);
    const share = positions.getY(i) + 0.5;
    positions.setXYZ(i, x, WATER_Y + up * height * crest(x, width, from) * share, -distance);
  }
  const top = new Color(color);
  return paint(geometry, ({ y }) =>
    top.clone().lerp(HORIZON, 0.6 * Math.max(0, 1 - Math.abs(y - WATER_Y) / (0.5 * height))),
  );
}

/** How high the ridge is at `x`, 0..1: the highest of the hills that stand there. */
function crest(x: number, width: number, from: number): number {
  let highest = 0.06;
  for (let k = -16; k <= 16; k++) {
    const middle = k * width * 0.95 + from + 4 * Math.sin(k * 2.3);
    const tall = 0.45 + 0.55 * Math.abs(Math.sin(k * 1.7 + from));
    const off = Math.abs(x - middle) / (width * (0.5 + 0.16 * Math.sin(k * 3.1)));
    highest = Math.max(highest, tall * (1 - off ** 2.4) + 0.012 * Math.sin(x * 1.9 + k));
  }
  return highest;
}

/** Bands of mist where hills and water meet. */
function mist(): Mesh {
  const geometry = new PlaneGeometry(260, 2.4, 1, 6);
  const material = new MeshBasicMaterial({ color: new Color("#fff8e6"), transparent: true, opacity: 0.55 });
  material.map = glowTexture();
  material.depthWrite = false;
  const mesh = new Mesh(geometry, material);
  mesh.position.set(0, WATER_Y + 0.25, -46);
  mesh.renderOrder = -5;
  return mesh;
}

function sun(): Sprite {
  const material = new SpriteMaterial({ map: glowTexture(), color: new Color("#ffe2a0"), opacity: 0.55 });
  material.blending = AdditiveBlending;
  material.depthWrite = false;
  const sprite = new Sprite(material);
  sprite.position.set(14, 4.5, -88);
  sprite.scale.setScalar(22);
  sprite.renderOrder = -12;
  return sprite;
}

/** The sun's trail on the water, towards the eyes. */
function sunPath(): Mesh {
  const geometry = new PlaneGeometry(7, 70);
  geometry.rotateX(-Math.PI / 2);
  const material = new MeshBasicMaterial({ map: glowTexture(), color: new Color("#ffeec0"), transparent: true });
  material.opacity = 0.5;
  material.depthTest = false;
  const mesh = new Mesh(geometry, material);
  mesh.position.set(5.2, WATER_Y + 0.01, -33);
  mesh.rotation.y = Math.atan2(-14, -88) + Math.PI;
  mesh.renderOrder = -4;
  return mesh;
}

/** A painted shape that lies behind all of a higher order. */
function behind(geometry: BufferGeometry, order: number, side = 0 as 0 | 1): Mesh {
  const material = new MeshBasicMaterial({ vertexColors: true, side, depthWrite: false });
  const mesh = new Mesh(geometry, material);
  mesh.renderOrder = order;
  return mesh;
}
