// Pictures painted once: a soft glow and the table's wood with its depth lines.
import { CanvasTexture, SRGBColorSpace } from "three";

/** A picture drawn once with a brush. */
export function painted(
  width: number,
  height: number,
  paint: (brush: CanvasRenderingContext2D) => void,
): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  const brush = canvas.getContext("2d");
  if (brush) paint(brush);
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}

const SEAM = "rgba(255,226,190,0.34)";
const LINE = "rgba(255,226,190,0.16)";
const GRAIN = "rgba(30,14,4,0.16)";

let glow: CanvasTexture | undefined;

/** A white spot that fades to nothing at its rim. */
export function glowTexture(): CanvasTexture {
  glow ??= painted(128, 128, (brush) => {
    const gradient = brush.createRadialGradient(64, 64, 0, 64, 64, 64);
    gradient.addColorStop(0, "rgba(255,255,255,1)");
    gradient.addColorStop(0.35, "rgba(255,255,255,0.5)");
    gradient.addColorStop(1, "rgba(255,255,255,0)");
    brush.fillStyle = gradient;
    brush.fillRect(0, 0, 128, 128);
  });
  return glow;
}

/**
 * A table top: boards running crosswise, `boards` of them in its depth, so that every seam is a step of distance, and
 * lines ahead, so that they run together towards the far edge.
 */
export function boardsTexture(boards: number, linesAhead: number): CanvasTexture {
  const texture = painted(1024, 512, (brush) => {
    const board = 512 / boards;
    for (let i = 0; i < boards; i++) {
      const light = 36 + (i % 2 === 0 ? 2.5 : -2) + 1.2 * Math.sin(i * 2.4);
      brush.fillStyle = `hsl(24 34% ${light}%)`;
      brush.fillRect(0, i * board, 1024, board);
      grain(brush, i * board, board, i);
      brush.fillStyle = SEAM;
      brush.fillRect(0, i * board, 1024, 2.5);
    }
    brush.fillStyle = LINE;
    for (let i = 1; i < linesAhead; i++) brush.fillRect((i * 1024) / linesAhead - 1, 0, 2, 512);
  });
  texture.anisotropy = 2;
  return texture;
}

function grain(brush: CanvasRenderingContext2D, top: number, height: number, seed: number): void {
  brush.fillStyle = GRAIN;
  for (let k = 0; k < 5; k++) {
    const y = top + height * (0.15 + 0.17 * k);
    const start = (seed * 331 + k * 197) % 700;
    brush.fillRect(start, y, 220 + ((seed * 71 + k * 53) % 180), 1.5);
  }
}
