// The quiet morning garden and the table in it: sky, hills, lawn. Scenery only, nothing acts here.
import {
  AdditiveBlending,
  BackSide,
  Color,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  RingGeometry,
  Scene,
  SphereGeometry,
  Sprite,
  SpriteMaterial,
  type Vector3,
} from "three";
import { paint } from "../../paint";
import { table } from "../../table";
import { glowTexture } from "../../textures";
import { plants } from "./plants";

const LAWN_Y = -1.15;
const LAWN_NEAR = new Color("#86b85f");
const LAWN_FAR = new Color("#c3dca0");
const LAWN_PALES_OVER_M = 26;
const ZENITH = new Color("#6fb3e0");
const MIDDLE = new Color("#bfe0ee");
const HORIZON = new Color("#fdf0d5");
const SKY_M = 80;
const HILLS: readonly { distance: number; height: number; waves: number; color: string }[] = [
  { distance: 34, height: 2.2, waves: 5.1, color: "#9cc492" },
  { distance: 46, height: 4.2, waves: 3.7, color: "#aecdb4" },
  { distance: 60, height: 7.5, waves: 2.3, color: "#c0d9d6" },
];

export function garden(): Scene {
  const scene = new Scene();
  scene.add(plants(LAWN_Y), lawn(), ...HILLS.map(hill), sky(), sunGlow(), table());
  return scene;
}

function sky(): Mesh {
  const geometry = paint(new SphereGeometry(SKY_M, 24, 32), ({ y }: Vector3) => {
    const up = Math.max(0, y / SKY_M);
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
    opacity: 0.4,
  });
  const sprite = new Sprite(material);
  sprite.position.set(-20, 6, -70);
  sprite.scale.setScalar(30);
  return sprite;
}

/** A ridge like cut paper: a bent strip whose upper edge rolls. */
function hill({ distance, height, waves, color }: (typeof HILLS)[number]): Mesh {
  const geometry = new PlaneGeometry(200, 1, 120, 1);
  const positions = geometry.getAttribute("position");
  for (let i = 0; i < positions.count; i++) {
    const x = positions.getX(i);
    const crest = height * (0.62 + 0.26 * Math.sin(x * 0.022 * waves + waves) + 0.12 * Math.sin(x * 0.09 * waves));
    positions.setXYZ(i, x, positions.getY(i) > 0 ? LAWN_Y + crest : LAWN_Y - 1, -distance);
  }
  return new Mesh(geometry, new MeshBasicMaterial({ color: new Color(color) }));
}

/** Rings of grass that grow paler with distance, as air makes them. */
function lawn(): Mesh {
  const geometry = new RingGeometry(0.01, 60, 40, 24);
  geometry.rotateX(-Math.PI / 2);
  paint(geometry, ({ x, z }) => LAWN_NEAR.clone().lerp(LAWN_FAR, Math.min(1, Math.hypot(x, z) / LAWN_PALES_OVER_M)));
  const mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true }));
  mesh.position.y = LAWN_Y;
  return mesh;
}
