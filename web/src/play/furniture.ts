// Plain painted shapes to make furniture of; all of a kind that can be merged.
import {
  BoxGeometry,
  type BufferGeometry,
  Color,
  CylinderGeometry,
  IcosahedronGeometry,
  LatheGeometry,
  Vector2,
} from "three";
import { shade } from "./paint";

/** A box by its middle and its sides. */
export function box(x: number, y: number, z: number, width: number, height: number, depth: number, color: string) {
  return coloured(new BoxGeometry(width, height, depth).translate(x, y, z), color);
}

export function ball(x: number, y: number, z: number, radius: number, color: string, detail = 1) {
  return coloured(new IcosahedronGeometry(radius, detail).translate(x, y, z), color);
}

/** A flat cylinder, tilted from lying towards standing upright before the eyes. */
export function disc(x: number, y: number, z: number, radius: number, height: number, color: string, tilt_rad = 0) {
  return coloured(new CylinderGeometry(radius, radius, height, 24).rotateX(tilt_rad).translate(x, y, z), color);
}

/** A half-outline of (radius, height) turned on a lathe and set down. */
export function turned(
  outline: readonly (readonly [number, number])[],
  x: number,
  y: number,
  z: number,
  color: string,
  segments = 20,
): BufferGeometry {
  const points = outline.map(([radius, height]) => new Vector2(radius, height));
  return coloured(new LatheGeometry(points, segments).translate(x, y, z), color);
}

function coloured(geometry: BufferGeometry, color: string): BufferGeometry {
  return shade(geometry.index ? geometry.toNonIndexed() : geometry, new Color(color));
}
