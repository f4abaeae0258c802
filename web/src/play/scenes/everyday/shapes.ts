// Shapes of the things on the kitchen table: each in one piece, its colours on its corners. Metres; the origin is where the
// thing is gripped.
import {
  BoxGeometry,
  BufferAttribute,
  type BufferGeometry,
  Color,
  ConeGeometry,
  CylinderGeometry,
  LatheGeometry,
  SphereGeometry,
  TorusGeometry,
  Vector2,
  Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

/** How far beneath its grip each kind of thing ends: there its stand begins. */
export const FOOT_M: Readonly<Record<string, number>> = {
  cup: 0.06,
  jug: 0.09,
  cube: 0.045,
  barrel: 0.045,
  roof: 0.045,
  base: 0.045,
};
/** A thing is gripped from its outer side, so that the hand does not hide it: so much further inward than the hand it is. */
const GRIP_M = 0.052;
const GRIP_AHEAD_M = 0.02;
const SIP_M = [0.05, 0.05, 0.06] as const;

const TURNED = 18;
const BLOCK_M = 0.068;
const ENAMEL = "#2f8fb3";
const ENAMEL_RIM = "#fdfbf4";
const ENAMEL_INSIDE = "#f1e7d2";
const CLAY = "#e8ad33";
const CLAY_BAND = "#fff7e2";

type Outline = readonly (readonly [radius: number, height: number])[];

/** From the hand to the thing it grips; `inward` is +1 where the patient's middle is to the right of the acting arm. */
export function gripOf(inward: number): Vector3 {
  return new Vector3(inward * GRIP_M, 0, -GRIP_AHEAD_M);
}

/** From the hand to the cup that is drunk from: between hand and mouth, where it is seen. */
export function sipOf(inward: number): Vector3 {
  return new Vector3(inward * SIP_M[0], SIP_M[1], SIP_M[2]);
}

/** A shape by the kind of thing. */
export function shapeOf(kind: string, inward: number): BufferGeometry {
  if (kind === "cup") return cup(inward).translate(0, 0.04, 0);
  if (kind === "jug") return jug(inward).translate(0, 0.06, 0);
  return (kind === "barrel" ? barrel() : kind === "roof" ? roof() : cube()).translate(0, 0.035, 0);
}

/** An enamel mug, its handle outward. */
function cup(inward: number): BufferGeometry {
  const handle = new TorusGeometry(0.022, 0.006, 5, 10).translate(-inward * 0.046, -0.056, 0);
  const outside: Outline = [
    [0, -0.1],
    [0.034, -0.1],
    [0.038, -0.094],
    [0.041, -0.012],
  ];
  const inside: Outline = [
    [0.038, -0.012],
    [0.034, -0.092],
    [0, -0.092],
  ];
  const rim = new TorusGeometry(0.0395, 0.0028, 4, TURNED).rotateX(Math.PI / 2).translate(0, -0.012, 0);
  return merged([
    tinted(lathe(outside), ENAMEL),
    tinted(lathe(inside), ENAMEL_INSIDE),
    tinted(handle, ENAMEL),
    tinted(rim, ENAMEL_RIM),
  ]);
}

/** A clay jug, its spout inward and its handle outward. */
function jug(inward: number): BufferGeometry {
  const body: Outline = [
    [0, -0.15],
    [0.036, -0.15],
    [0.05, -0.118],
    [0.051, -0.095],
    [0.043, -0.062],
    [0.031, -0.034],
    [0.035, -0.006],
    [0.031, -0.006],
    [0.027, -0.034],
    [0, -0.05],
  ];
  const band: Outline = [
    [0.0525, -0.112],
    [0.0525, -0.098],
  ];
  const spout = new ConeGeometry(0.02, 0.034, 10, 1, true).rotateZ(inward * 2.2).translate(inward * 0.036, -0.012, 0);
  const handle = new TorusGeometry(0.03, 0.007, 5, 10).scale(0.8, 1.25, 1).translate(-inward * 0.048, -0.062, 0);
  return merged([tinted(lathe(body), CLAY), tinted(lathe(band), CLAY_BAND), tinted(spout, CLAY), tinted(handle, CLAY)]);
}

/** A wooden block with a window on every side. */
function cube(): BufferGeometry {
  const parts = [tinted(new BoxGeometry(BLOCK_M, BLOCK_M, BLOCK_M), "#3f8f5a")];
  for (const turn of [0, 1, 2, 3]) {
    const pane = new BoxGeometry(0.024, 0.032, 0.003).translate(0, 0.004, BLOCK_M / 2 + 0.001);
    const sill = new BoxGeometry(0.034, 0.005, 0.008).translate(0, -0.016, BLOCK_M / 2 + 0.002);
    parts.push(
      tinted(pane.rotateY((turn * Math.PI) / 2), "#fff2c2"),
      tinted(sill.rotateY((turn * Math.PI) / 2), "#f7f1e3"),
    );
  }
  return merged(parts).translate(0, -0.046, 0);
}

/** A round block with two hoops. */
function barrel(): BufferGeometry {
  const hoop = (height: number) =>
    tinted(new CylinderGeometry(0.0365, 0.0365, 0.01, TURNED).translate(0, height, 0), "#fff2c2");
  const body = tinted(new CylinderGeometry(0.035, 0.035, BLOCK_M, TURNED), "#8a5fb5");
  return merged([body, hoop(0.019), hoop(-0.019)]).translate(0, -0.046, 0);
}

/** A pointed roof with a ball on top. */
function roof(): BufferGeometry {
  const tiles = tinted(new ConeGeometry(0.056, 0.062, 4).rotateY(Math.PI / 4).translate(0, -0.043, 0), "#d8453a");
  const eaves = tinted(new BoxGeometry(0.082, 0.008, 0.082).translate(0, -0.076, 0), "#a8322a");
  const ball = tinted(new SphereGeometry(0.011, 10, 8).translate(0, -0.006, 0), "#ffd23c");
  return merged([tiles, eaves, ball]);
}

/** Gives every corner of a shape one colour and drops what shapes do not share, so that they can be merged. */
export function tinted<G extends BufferGeometry>(geometry: G, color: string): BufferGeometry {
  const shape = geometry.index ? geometry.toNonIndexed() : geometry;
  const count = shape.getAttribute("position").count;
  const colors = new Float32Array(count * 3);
  const tint = new Color(color);
  for (let i = 0; i < count; i++) tint.toArray(colors, 3 * i);
  shape.setAttribute("color", new BufferAttribute(colors, 3));
  shape.deleteAttribute("uv");
  return shape;
}

export function merged(parts: BufferGeometry[]): BufferGeometry {
  return mergeGeometries(parts);
}

function lathe(outline: Outline): BufferGeometry {
  return new LatheGeometry(
    outline.map(([radius, height]) => new Vector2(radius, height)),
    TURNED,
  );
}
