// Colours painted onto the corners of a shape, light included: scenery that needs no lamp.
import { BufferAttribute, type BufferGeometry, Color, Vector3 } from "three";

/** Where the morning light on the scenery comes from. */
const LIGHT = new Vector3(-0.45, 0.8, 0.4).normalize();
const DIMMEST = 0.66;

/** Gives every corner the colour of its place, and drops texture coordinates, so that shapes can be merged. */
export function paint<G extends BufferGeometry>(geometry: G, colorAt: (place: Vector3) => Color): G {
  const positions = geometry.getAttribute("position");
  const colors = new Float32Array(positions.count * 3);
  const place = new Vector3();
  for (let i = 0; i < positions.count; i++) colorAt(place.fromBufferAttribute(positions, i)).toArray(colors, 3 * i);
  geometry.setAttribute("color", new BufferAttribute(colors, 3));
  geometry.deleteAttribute("uv");
  return geometry;
}

/** One colour, brighter on the side of the light. */
export function shade<G extends BufferGeometry>(geometry: G, color: Color): G {
  const normals = geometry.getAttribute("normal");
  let i = 0;
  return paint(geometry, () => {
    const facing = new Vector3().fromBufferAttribute(normals, i++).dot(LIGHT);
    return color.clone().multiplyScalar(DIMMEST + (1.08 - DIMMEST) * Math.max(0, 0.35 + 0.65 * facing));
  });
}

/** One colour all over. */
export function tinted<G extends BufferGeometry>(geometry: G, color: string): G {
  const one = new Color(color);
  return paint(geometry, () => one);
}
