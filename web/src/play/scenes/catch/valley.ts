// A valley in blossom under far mountains, seen from a terrace of pale stone. Scenery only, nothing acts here.
import {
  BackSide,
  BoxGeometry,
  type BufferGeometry,
  CanvasTexture,
  Color,
  CylinderGeometry,
  IcosahedronGeometry,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  RingGeometry,
  Scene,
  SphereGeometry,
  SRGBColorSpace,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { paint, shade } from "../../paint";
import { TABLE_Y } from "../../table";

const HALF_WIDTH_M = 1.35;
const NEAR_Z = -0.2;
const FAR_Z = -1.55;
const SLAB_M = 0.27;
const VALLEY_Y = -2.4;
const SKY_M = 90;
const ZENITH = new Color("#8fc9e8");
const HORIZON = new Color("#fff4ea");
const MEADOW_NEAR = new Color("#7fa878");
const MEADOW_FAR = new Color("#d5e3cf");
const MOUNTAINS = [
  { distance: 40, height: 3.4, waves: 0.21, color: "#a9c2b8" },
  { distance: 54, height: 5.6, waves: 0.12, color: "#b4c6d6" },
  { distance: 72, height: 9.5, waves: 0.07, color: "#cbd6e8" },
] as const;
const BLOSSOM = ["#f4b6c8", "#eb9db6", "#fbd5de", "#f7c4d0"] as const;
const TREES = 84;
const TRUNK = new Color("#7c5a52");
const RAIL = new Color("#d9d2c4");

/** Whether a shadow straight beneath falls on the stones. */
export function isOverTerrace(x: number, z: number): boolean {
  return Math.abs(x) < HALF_WIDTH_M && z < NEAR_Z && z > FAR_Z;
}

export function valley(): Scene {
  const scene = new Scene();
  const plain = new MeshBasicMaterial({ vertexColors: true });
  const things = mergeGeometries([...trees(), ...rail()].map((one) => (one.index ? one.toNonIndexed() : one)));
  scene.add(sky(), ...MOUNTAINS.map(mountain), meadow(), new Mesh(things, plain), stones());
  return scene;
}

function sky(): Mesh {
  const geometry = paint(new SphereGeometry(SKY_M, 24, 32), ({ y }) =>
    HORIZON.clone().lerp(ZENITH, Math.min(1, Math.max(0, y / SKY_M) * 3)),
  );
  return new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: BackSide, depthWrite: false }));
}

/** A ridge like cut paper, paler at its foot, where the mist lies. */
function mountain({ distance, height, waves, color }: (typeof MOUNTAINS)[number]): Mesh {
  const geometry = new PlaneGeometry(260, 1, 200, 3);
  const positions = geometry.getAttribute("position");
  for (let i = 0; i < positions.count; i++) {
    const x = positions.getX(i);
    const crest = 0.55 + 0.3 * Math.sin(x * waves + height) + 0.15 * Math.sin(x * waves * 3.3);
    positions.setXYZ(i, x, VALLEY_Y + height * crest * (positions.getY(i) + 0.5), -distance);
  }
  const top = new Color(color);
  paint(geometry, ({ y }) => HORIZON.clone().lerp(top, Math.min(1, Math.max(0, (y - VALLEY_Y) / (0.5 * height)))));
  return new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true }));
}

function meadow(): Mesh {
  const geometry = new RingGeometry(0.01, 80, 40, 30);
  geometry.rotateX(-Math.PI / 2);
  paint(geometry, ({ x, z }) => MEADOW_NEAR.clone().lerp(MEADOW_FAR, Math.min(1, Math.hypot(x, z) / 30)));
  const mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true }));
  mesh.position.y = VALLEY_Y;
  return mesh;
}

/** Round crowns on the slope below, smaller and paler with distance. */
function trees(): BufferGeometry[] {
  return Array.from({ length: TREES }, (_, i) => {
    const far = (0.03 + i * 0.414) % 1;
    const away = 4.2 + 24 * far * far;
    const x = (((i * 0.618) % 1) * 2 - 1) * (2.4 + away * 0.95);
    return tree(
      x,
      -away,
      0.62 + 0.26 * ((i * 0.73) % 1),
      new Color(BLOSSOM[i % BLOSSOM.length]),
      Math.min(1, away / 34),
    );
  }).flat();
}

function tree(x: number, z: number, size_m: number, color: Color, pale: number): BufferGeometry[] {
  const tint = color.clone().lerp(HORIZON, 0.7 * pale);
  const stem = new CylinderGeometry(0.05 * size_m, 0.09 * size_m, 1.4 * size_m, 6);
  stem.translate(x, VALLEY_Y + 0.6 * size_m, z);
  const balls = [
    [0, 1.55, 0.62],
    [-0.5, 1.25, 0.44],
    [0.5, 1.3, 0.46],
    [0.1, 1.2, 0.5],
  ] as const;
  return [
    shade(stem.toNonIndexed(), TRUNK.clone().lerp(HORIZON, 0.6 * pale)),
    ...balls.map(([dx, up, radius]) => {
      const ball = new IcosahedronGeometry(radius * size_m, pale < 0.35 ? 3 : 1);
      ball.translate(x + dx * size_m, VALLEY_Y + up * size_m, z + dx * 0.4 * size_m);
      return dappled(shade(ball, tint));
    }),
  ];
}

/** Blossom is not smooth: every face a little lighter or darker. */
function dappled(geometry: BufferGeometry): BufferGeometry {
  const colors = geometry.getAttribute("color");
  for (let i = 0; i < colors.count; i++) {
    const light = 1 + 0.07 * Math.sin(Math.floor(i / 3) * 12.9898);
    colors.setXYZ(i, colors.getX(i) * light, colors.getY(i) * light, colors.getZ(i) * light);
  }
  return geometry;
}

/** A low stone rail at the far edge, so that the terrace has an end. */
function rail(): BufferGeometry[] {
  const bar = new BoxGeometry(2 * HALF_WIDTH_M, 0.035, 0.07);
  bar.translate(0, TABLE_Y + 0.1, FAR_Z + 0.03);
  const posts = Array.from({ length: 9 }, (_, i) => {
    const post = new BoxGeometry(0.05, 0.1, 0.05);
    post.translate(-HALF_WIDTH_M + 0.04 + (i * (2 * HALF_WIDTH_M - 0.08)) / 8, TABLE_Y + 0.05, FAR_Z + 0.03);
    return post;
  });
  return [bar, ...posts].map((one) => shade(one.toNonIndexed(), RAIL));
}

/** Square slabs: each joint is a step of distance. */
function stones(): Mesh {
  const depth_m = NEAR_Z - FAR_Z;
  const map = slabs((2 * HALF_WIDTH_M) / SLAB_M, depth_m / SLAB_M);
  const top = new MeshBasicMaterial({ map });
  top.addEventListener("dispose", () => map.dispose());
  const side = new MeshBasicMaterial({ color: new Color("#857b6e") });
  const mesh = new Mesh(new BoxGeometry(2 * HALF_WIDTH_M, 0.06, depth_m), [side, side, top, side, side, side]);
  mesh.position.set(0, TABLE_Y - 0.03, (NEAR_Z + FAR_Z) / 2);
  return mesh;
}

function slabs(across: number, deep: number): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = 1024;
  canvas.height = 512;
  const brush = canvas.getContext("2d");
  if (brush) {
    pave(brush, Math.round(across), Math.round(deep));
    strew(brush);
  }
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  texture.anisotropy = 4;
  return texture;
}

function pave(brush: CanvasRenderingContext2D, across: number, deep: number): void {
  brush.fillStyle = "#8d8375";
  brush.fillRect(0, 0, 1024, 512);
  for (let i = 0; i < across; i++)
    for (let k = 0; k < deep; k++) {
      const light = 66 + 3 * Math.sin(i * 2.7 + k * 4.1) + (((i + k) % 2) * 2 - 1);
      brush.fillStyle = `hsl(38 20% ${light}%)`;
      brush.fillRect((i * 1024) / across + 2, (k * 512) / deep + 2, 1024 / across - 4, 512 / deep - 4);
    }
}

/** Petals that have fallen. */
function strew(brush: CanvasRenderingContext2D): void {
  for (let i = 0; i < 130; i++) {
    brush.fillStyle = i % 3 ? "#ffd9e4" : "#fff2f5";
    brush.beginPath();
    brush.ellipse(((i * 0.618) % 1) * 1024, ((i * 0.414) % 1) * 512, 5, 3, i, 0, 2 * Math.PI);
    brush.fill();
  }
}
