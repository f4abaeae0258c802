// A quiet room on a grey day, lit by a lamp, so that the window on the table is what shines. Scenery only.
import {
  AdditiveBlending,
  type BufferGeometry,
  Color,
  Mesh,
  MeshBasicMaterial,
  Scene,
  Sprite,
  SpriteMaterial,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { ball, box, disc, turned } from "../../furniture";
import { table } from "../../table";
import { glowTexture } from "../../textures";

const FLOOR_Y = -1.2;
const WALL_Z = -2.7;
const WALL = "#3f5a6b";
const PANEL = "#34495a";
const WOOD = "#6f4f38";
const CARPET = "#8c9a8a";
const SHELF_X = 1.35;
const LAMP_X = -1.5;
const BOOKS = ["#c8694f", "#e0b15a", "#7fa58c", "#d9cdb5", "#8a6f9e", "#5f88ad"] as const;

export function evening(): Scene {
  const scene = new Scene();
  scene.background = new Color(WALL);
  const shapes = [...room(), ...shelf(), ...lamp(), ...plant(), ...armchair()];
  scene.add(new Mesh(mergeGeometries(shapes), new MeshBasicMaterial({ vertexColors: true })));
  scene.add(lampLight(LAMP_X, 0.32, 1.9, 0.5), lampLight(LAMP_X, 0.3, 0.8, 0.7), table());
  return scene;
}

function room(): BufferGeometry[] {
  const panels = Array.from({ length: 12 }, (_, i) =>
    box((i - 5.5) * 0.62, -0.78, WALL_Z + 0.03, 0.52, 0.62, 0.02, i % 2 === 0 ? "#3a5163" : "#385062"),
  );
  return [
    box(0, 0, WALL_Z - 0.05, 14, 3, 0.1, WALL),
    box(0, -0.78, WALL_Z, 14, 0.84, 0.03, PANEL),
    box(0, -0.35, WALL_Z + 0.02, 14, 0.05, 0.06, "#4d6a7d"),
    box(0, FLOOR_Y - 0.05, -1.6, 14, 0.1, 3, CARPET),
    ...panels,
  ];
}

/** Shelves full of books. */
function shelf(): BufferGeometry[] {
  const boards = [-0.62, -0.26, 0.1, 0.46].map((y) => box(SHELF_X, y, WALL_Z + 0.2, 1.25, 0.03, 0.3, WOOD));
  const books = [-0.6, -0.24, 0.12].flatMap((y, row) =>
    Array.from({ length: 15 }, (_, i) => {
      const tall = 0.2 + 0.06 * Math.sin(i * 2.1 + row);
      const color = BOOKS[(i * 5 + row * 2) % BOOKS.length] ?? WOOD;
      return box(SHELF_X - 0.54 + i * 0.077, y + tall / 2, WALL_Z + 0.22, 0.06, tall, 0.2, color);
    }),
  );
  const sides = [-0.62, 0.62].map((dx) => box(SHELF_X + dx, -0.3, WALL_Z + 0.2, 0.04, 1.6, 0.3, WOOD));
  return [...boards, ...sides, ...books];
}

function lamp(): BufferGeometry[] {
  const shade = [
    [0.2, 0],
    [0.12, 0.24],
  ] as const;
  return [
    turned(shade, LAMP_X, 0.2, WALL_Z + 0.5, "#ffe3a6"),
    disc(LAMP_X, -0.5, WALL_Z + 0.5, 0.015, 1.4, "#c9a25f"),
    disc(LAMP_X, FLOOR_Y + 0.02, WALL_Z + 0.5, 0.16, 0.03, "#c9a25f"),
  ];
}

function lampLight(x: number, y: number, size: number, opacity: number): Sprite {
  const paint = new SpriteMaterial({
    map: glowTexture(),
    color: new Color("#ffcf86"),
    blending: AdditiveBlending,
    depthWrite: false,
    opacity,
  });
  const sprite = new Sprite(paint);
  sprite.position.set(x, y, WALL_Z + 0.62);
  sprite.scale.setScalar(size);
  return sprite;
}

function plant(): BufferGeometry[] {
  const pot = [
    [0, 0],
    [0.13, 0],
    [0.17, 0.26],
  ] as const;
  const leaves = Array.from({ length: 16 }, (_, i) => {
    const around = i * 2.4;
    const out = 0.08 + 0.014 * i;
    return ball(
      0.45 + out * Math.cos(around),
      -0.72 + 0.045 * i,
      -2.3 + out * Math.sin(around),
      0.1,
      i % 3 ? "#4f8560" : "#5f9a6c",
    );
  });
  return [turned(pot, 0.45, FLOOR_Y, -2.3, "#b8694a"), ...leaves];
}

function armchair(): BufferGeometry[] {
  const cloth = "#8a4f4a";
  return [
    box(-0.62, -0.86, -2.2, 0.78, 0.24, 0.6, cloth),
    box(-0.62, -0.52, -2.48, 0.78, 0.7, 0.16, "#7d4641"),
    box(-1.02, -0.76, -2.2, 0.14, 0.4, 0.62, "#96574f"),
    box(-0.22, -0.76, -2.2, 0.14, 0.4, 0.62, "#96574f"),
    ball(-0.6, -0.62, -2.32, 0.15, "#e0b15a", 2),
  ];
}
