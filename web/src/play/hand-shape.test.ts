import { Box3, type BufferGeometry, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { handGeometry } from "./hand-shape";
import { surfaceNets } from "./surface-nets";

function corners(geometry: BufferGeometry): Vector3[] {
  const positions = geometry.getAttribute("position");
  return Array.from({ length: positions.count }, (_, i) => new Vector3().fromBufferAttribute(positions, i));
}

/** Every edge of a closed surface belongs to as many triangles one way as the other. */
function isClosed(geometry: BufferGeometry): boolean {
  const index = geometry.getIndex()?.array ?? [];
  const balance = new Map<string, number>();
  for (let i = 0; i < index.length; i += 3) {
    for (const [a, b] of [
      [0, 1],
      [1, 2],
      [2, 0],
    ] as const) {
      const [from = 0, to = 0] = [index[i + a], index[i + b]];
      const key = from < to ? `${from}-${to}` : `${to}-${from}`;
      balance.set(key, (balance.get(key) ?? 0) + (from < to ? 1 : -1));
    }
  }
  return [...balance.values()].every((count) => count === 0);
}

/** Six times the volume inside; positive when the faces look outward. */
function volume(geometry: BufferGeometry): number {
  const at = corners(geometry);
  const index = geometry.getIndex()?.array ?? [];
  let sum = 0;
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [at[index[i] ?? 0], at[index[i + 1] ?? 0], at[index[i + 2] ?? 0]];
    if (a && b && c) sum += a.dot(b.clone().cross(c)) / 6;
  }
  return sum;
}

describe("surfaceNets", () => {
  const ball = surfaceNets((x, y, z) => Math.hypot(x, y, z) - 0.5, [-0.7, -0.7, -0.7], [0.7, 0.7, 0.7], 0.05);

  it("puts a ball's corners on the ball, looking outward", () => {
    for (const corner of corners(ball)) expect(corner.length()).toBeCloseTo(0.5, 1);
    expect(volume(ball)).toBeCloseTo((4 / 3) * Math.PI * 0.5 ** 3, 1);
  });

  it("closes the surface", () => {
    expect(isClosed(ball)).toBe(true);
  });
});

describe("handGeometry", () => {
  const left = handGeometry("left");
  const right = handGeometry("right");

  it("is a closed hand of a grown person's size, faces outward", () => {
    const size = new Box3().setFromPoints(corners(left)).getSize(new Vector3());
    expect(isClosed(left)).toBe(true);
    expect(size.y).toBeGreaterThan(0.17);
    expect(size.y).toBeLessThan(0.24);
    expect(volume(left)).toBeGreaterThan(0.0002);
  });

  it("has its thumb towards +x on the left and −x on the right", () => {
    const thumbs = [left, right].map((hand) => new Box3().setFromPoints(corners(hand)));
    expect(thumbs[0]?.max.x).toBeCloseTo(-(thumbs[1]?.min.x ?? 0), 2);
    expect(thumbs[0]?.max.x ?? 0).toBeGreaterThan(-(thumbs[0]?.min.x ?? 0) + 0.005);
  });
});
