// A bright kitchen in the morning: a window over the worktop, cupboards, tiles, and the table. Scenery only.
import { Color, Mesh, MeshBasicMaterial, PlaneGeometry, Scene } from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { ball, box, disc, turned } from "../../furniture";
import { table } from "../../table";
import { painted } from "../../textures";
import { morning } from "./morning";

const FLOOR_Y = -1.2;
const WALL_Z = -2.6;
const FRONT_Z = -2.02;
const TOP_Y = -0.28;
const SILL_Y = 0.02;
const WINDOW = { width: 1.7, height: 1.1 };
const WALL = "#f4e6cf";
const DOOR = "#8fae9a";
const DOOR_EDGE = "#7b9b88";
const WORKTOP = "#b98556";
const FRAME = "#fbf7ee";
const DOORS = 7;
const DOOR_M = 0.62;
const TILE = { color: "#fdf8ec", joint: "#dccfb8" };

export function kitchen(): Scene {
  const scene = new Scene();
  scene.background = new Color(WALL);
  scene.add(view(), tiles(), furniture(), table());
  return scene;
}

/** The garden beyond the glass. */
function view(): Mesh {
  const mesh = new Mesh(
    new PlaneGeometry(WINDOW.width, WINDOW.height),
    new MeshBasicMaterial({ map: painted(512, 330, morning) }),
  );
  mesh.position.set(0, SILL_Y + WINDOW.height / 2, WALL_Z + 0.012);
  return mesh;
}

/** Glazed tiles between worktop and window, in staggered rows. */
function tiles(): Mesh {
  const map = painted(1024, 128, (brush) => {
    brush.fillStyle = TILE.joint;
    brush.fillRect(0, 0, 1024, 128);
    for (let row = 0; row < 4; row++) {
      for (let column = -1; column < 24; column++) {
        const light = 95 + 2.2 * Math.sin(row * 3.1 + column * 1.9);
        brush.fillStyle = (row + column) % 7 === 3 ? "#cfe3dc" : `hsl(42 60% ${light}%)`;
        brush.fillRect(column * 44 + (row % 2) * 22 + 1, row * 32 + 1, 42, 30);
      }
    }
  });
  const mesh = new Mesh(new PlaneGeometry(4.4, 0.3), new MeshBasicMaterial({ map }));
  mesh.position.set(0, TOP_Y + 0.15, WALL_Z + 0.01);
  return mesh;
}

/** Everything made of plain shapes, in one piece. */
function furniture(): Mesh {
  const shapes = [...room(), ...cupboards(), ...frame(), ...curtains(), ...onTheSill(), ...onTheWorktop(), ...shelf()];
  return new Mesh(mergeGeometries(shapes), new MeshBasicMaterial({ vertexColors: true }));
}

function room() {
  return [box(0, 0, WALL_Z - 0.05, 14, 3, 0.1, WALL), box(0, FLOOR_Y - 0.05, -1.6, 14, 0.1, 3, "#c79a6b")];
}

function cupboards() {
  const doors = Array.from({ length: DOORS }, (_, i) => {
    const x = (i - (DOORS - 1) / 2) * DOOR_M;
    const middle_y = (FLOOR_Y + TOP_Y) / 2;
    return [
      box(x, middle_y, FRONT_Z, DOOR_M - 0.015, TOP_Y - FLOOR_Y - 0.06, 0.02, DOOR),
      box(x, middle_y, FRONT_Z + 0.012, DOOR_M - 0.13, TOP_Y - FLOOR_Y - 0.2, 0.012, DOOR_EDGE),
      ball(x + (i % 2 === 0 ? 0.22 : -0.22), TOP_Y - 0.16, FRONT_Z + 0.03, 0.018, "#e9d9b0"),
    ];
  });
  const depth = FRONT_Z - WALL_Z + 0.05;
  const body = box(0, (FLOOR_Y + TOP_Y) / 2, FRONT_Z - 0.1, DOORS * DOOR_M, TOP_Y - FLOOR_Y - 0.1, 0.15, "#5f7c6d");
  return [body, box(0, TOP_Y - 0.02, (FRONT_Z + WALL_Z) / 2 + 0.02, 4.6, 0.04, depth, WORKTOP), ...doors.flat()];
}

function frame() {
  const { width, height } = WINDOW;
  const z = WALL_Z + 0.03;
  const bar = (x: number, w: number) => box(x, SILL_Y + height / 2, z, w, height, 0.04, FRAME);
  return [
    bar(-width / 2, 0.07),
    bar(0, 0.04),
    bar(width / 2, 0.07),
    box(0, SILL_Y, z + 0.06, width + 0.3, 0.035, 0.16, FRAME),
    box(0, SILL_Y + 0.42, z, width, 0.03, 0.03, FRAME),
  ];
}

/** Striped curtains drawn to both sides. */
function curtains() {
  return [-1, 1].flatMap((side) =>
    Array.from({ length: 6 }, (_, fold) => {
      const x = side * (WINDOW.width / 2 + 0.06 + fold * 0.05);
      const color = fold % 2 === 0 ? "#e88f72" : "#fff4e2";
      return turned(
        [
          [0.03, -0.12],
          [0.034, 0.4],
          [0.024, 1.1],
        ],
        x,
        SILL_Y,
        WALL_Z + 0.08 + 0.01 * (fold % 2),
        color,
        8,
      );
    }),
  );
}

function onTheSill() {
  const pots = [-0.62, 0.36, 0.68].flatMap((x, i) => [
    turned(
      [
        [0, 0],
        [0.045, 0],
        [0.06, 0.09],
        [0.065, 0.1],
      ],
      x,
      SILL_Y + 0.017,
      WALL_Z + 0.13,
      "#c8663f",
    ),
    ...leaves(x, SILL_Y + 0.16, WALL_Z + 0.13, i),
  ]);
  return pots;
}

function leaves(x: number, y: number, z: number, seed: number) {
  return Array.from({ length: 7 }, (_, i) => {
    const around = i * 2.4 + seed;
    const flower = seed === 1 || i % 3 === 0;
    const size = flower ? 0.03 : 0.05;
    const color = flower && i % 2 === 0 ? ["#f27d9c", "#fff1a8", "#f6a1c0"][seed % 3] : "#5f9d55";
    return ball(x + 0.05 * Math.cos(around), y + 0.02 * i * 0.7, z + 0.04 * Math.sin(around), size, color ?? "#5f9d55");
  });
}

function onTheWorktop() {
  const z = (FRONT_Z + WALL_Z) / 2;
  return [...kettle(-1.15, z), ...jars(0.95, z), ...fruitBowl(-0.45, z), ...bread(0.35, z + 0.08)];
}

function kettle(x: number, z: number) {
  const body = [
    [0, 0],
    [0.13, 0],
    [0.14, 0.05],
    [0.11, 0.16],
    [0.05, 0.21],
    [0, 0.215],
  ] as const;
  return [turned(body, x, TOP_Y, z, "#d9574a"), ball(x, TOP_Y + 0.23, z, 0.022, "#2d2a28")];
}

function jars(x: number, z: number) {
  return [0, 1, 2].flatMap((i) => {
    const height = 0.24 - 0.045 * i;
    const at = x + i * 0.2;
    const glass = [
      [0, 0],
      [0.075, 0],
      [0.078, height * 0.9],
      [0.06, height],
    ] as const;
    return [
      turned(glass, at, TOP_Y, z, ["#f2dfb4", "#e8c6a0", "#cfe0c3"][i] ?? "#f2dfb4"),
      disc(at, TOP_Y + height + 0.012, z, 0.066, 0.03, "#a8713f"),
    ];
  });
}

function fruitBowl(x: number, z: number) {
  const bowl = [
    [0, 0],
    [0.06, 0],
    [0.07, 0.02],
    [0.17, 0.09],
    [0.175, 0.1],
  ] as const;
  const fruit = [
    [-0.07, 0.12, 0.03, "#f39a1f"],
    [0.05, 0.13, 0.05, "#e14b3b"],
    [-0.01, 0.15, -0.06, "#f3c530"],
    [0.1, 0.12, -0.03, "#8fbf4a"],
  ] as const;
  return [
    turned(bowl, x, TOP_Y, z, "#4f8fb0"),
    ...fruit.map(([dx, dy, dz, color]) => ball(x + dx, TOP_Y + dy, z + dz, 0.055, color, 2)),
  ];
}

function bread(x: number, z: number) {
  const loaf = ball(0, 0, 0, 1, "#c98a45", 2).scale(0.17, 0.075, 0.08);
  return [box(x, TOP_Y + 0.01, z, 0.46, 0.02, 0.2, "#e2bd87"), loaf.translate(x, TOP_Y + 0.07, z)];
}

/** A shelf with plates, beside the window. */
function shelf() {
  const plates = [0, 1, 2].flatMap((i) => [
    disc(
      1.62 + i * 0.24,
      0.18,
      WALL_Z + 0.07,
      0.1,
      0.012,
      ["#7fb0c8", "#f6f0e2", "#e6a07c"][i] ?? "#f6f0e2",
      Math.PI / 2 - 0.2,
    ),
  ]);
  const mugs = [0, 1, 2].map((i) =>
    turned(
      [
        [0, 0],
        [0.045, 0],
        [0.05, 0.1],
      ],
      -1.5 - i * 0.19,
      0.09,
      WALL_Z + 0.11,
      ["#e88f72", "#8fae9a", "#f3c530"][i] ?? "#e88f72",
    ),
  );
  return [
    box(1.85, 0.06, WALL_Z + 0.08, 0.9, 0.03, 0.18, WORKTOP),
    box(-1.7, 0.07, WALL_Z + 0.1, 0.75, 0.03, 0.2, WORKTOP),
    ...plates,
    ...mugs,
  ];
}
