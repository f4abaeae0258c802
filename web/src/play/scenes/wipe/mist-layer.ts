// The mist as a small picture that lies on the glass: it hides the landscape but for its colours, its edges are ruffled,
// and what belongs to the patch is outlined and hatched. Painted by the processor, and only where something changed: a
// shader would be computed for every point of the screen, which a machine without a graphics card cannot bear.
import { DataTexture, LinearFilter, RGBAFormat } from "three";
import type { Cells } from "./cells";

/** Points of the picture along a cell's side. */
const FINE = 10;
/** Mist clears, and the patch is marked, at this speed. */
const CHANGING_PER_S = 9;
const SETTLED = 0.004;
const RUFFLE = 0.34;
const FOG = [196, 212, 222] as const;
const FOG_SHARE = 0.72;
const HATCH_SHARE = 0.3;
const DARK = [12, 34, 56] as const;
const BRIGHT = [255, 204, 64] as const;

export class MistLayer {
  readonly texture: DataTexture;
  private readonly width: number;
  private readonly height: number;
  private readonly bytes: Uint8Array;
  private readonly mist: Float32Array;
  private readonly patch: Float32Array;
  private hues: Uint8ClampedArray = new Uint8ClampedArray();

  constructor(
    private readonly columns: number,
    private readonly rows: number,
  ) {
    this.width = columns * FINE;
    this.height = rows * FINE;
    this.bytes = new Uint8Array(4 * this.width * this.height);
    this.mist = new Float32Array(columns * rows);
    this.patch = new Float32Array(columns * rows);
    this.texture = new DataTexture(this.bytes, this.width, this.height, RGBAFormat);
    this.texture.magFilter = LinearFilter;
    this.texture.minFilter = LinearFilter;
  }

  /** Lies over another landscape, all at once as misted as it is said to be. */
  cover(landscape: CanvasImageSource, cells: Cells): void {
    this.hues = blurred(landscape, this.width, this.height, this.columns, this.rows);
    this.approach(cells, 1);
    for (let i = 0; i < this.columns * this.rows; i++) this.paintAround(i);
    this.texture.needsUpdate = true;
  }

  animate(dt_s: number, cells: Cells): void {
    const changed = this.approach(cells, Math.min(1, dt_s * CHANGING_PER_S));
    for (const i of changed) this.paintAround(i);
    if (changed.length > 0) this.texture.needsUpdate = true;
  }

  /** Which cells are not what they were. */
  private approach(cells: Cells, share: number): number[] {
    const changed: number[] = [];
    for (let i = 0; i < cells.mist.length; i++) {
      const moved = move(this.mist, i, cells.mist[i] ?? 0, share);
      if (move(this.patch, i, cells.patch[i] ? 1 : 0, share) || moved) changed.push(i);
    }
    return changed;
  }

  /** Paints every point whose look hangs on cell `i`: those up to its neighbours' middles. */
  private paintAround(i: number): void {
    const left = Math.max(0, ((i % this.columns) - 0.5) * FINE);
    const top = Math.max(0, (Math.floor(i / this.columns) - 0.5) * FINE);
    const right = Math.min(this.width, left + 2 * FINE);
    const bottom = Math.min(this.height, top + 2 * FINE);
    for (let y = top; y < bottom; y++) for (let x = left; x < right; x++) this.paint(x, y);
  }

  private paint(x: number, y: number): void {
    const noise = chance(x, y);
    const raw = this.between(this.mist, x, y);
    const mist = step(0.34, 0.6, raw + RUFFLE * noise * (1 - Math.abs(2 * raw - 1)));
    const patch = this.between(this.patch, x, y);
    const hatched = patch > 0.45 && (x + y) % 9 < 4 ? HATCH_SHARE : 0;
    // The texture's first row is the lowest, the canvas' the highest.
    const to = 4 * ((this.height - 1 - y) * this.width + x);
    const from = 4 * (y * this.width + x);
    const line = lineOf(patch);
    for (let c = 0; c < 3; c++) {
      const fog = (this.hues[from + c] ?? 0) * (1 - FOG_SHARE) + (FOG[c] ?? 0) * (FOG_SHARE + 0.1 * noise);
      this.bytes[to + c] = Math.min(255, line?.[c] ?? fog * (1 - hatched));
    }
    this.bytes[to + 3] = Math.round(255 * (line ? Math.max(0.9, mist) : mist));
  }

  /** A value of the cells at a point of the picture, evenly between their middles. */
  private between(values: Float32Array, x: number, y: number): number {
    const u = Math.min(this.columns - 1, Math.max(0, (x + 0.5) / FINE - 0.5));
    const v = Math.min(this.rows - 1, Math.max(0, (y + 0.5) / FINE - 0.5));
    const i = Math.floor(v) * this.columns + Math.floor(u);
    const right = u % 1 > 0 ? 1 : 0;
    const down = v % 1 > 0 ? this.columns : 0;
    const upper = mixed(values[i] ?? 0, values[i + right] ?? 0, u % 1);
    return mixed(upper, mixed(values[i + down] ?? 0, values[i + down + right] ?? 0, u % 1), v % 1);
  }
}

/** Takes a value nearer to what is wanted; whether it was elsewhere. */
function move(values: Float32Array, i: number, wanted: number, share: number): boolean {
  const now = values[i] ?? 0;
  if (now === wanted) return false;
  const next = now + (wanted - now) * share;
  values[i] = Math.abs(next - wanted) < SETTLED ? wanted : next;
  return true;
}

function mixed(a: number, b: number, share: number): number {
  return a + (b - a) * share;
}

/** 0 up to `low`, 1 from `high`, smoothly between. */
function step(low: number, high: number, value: number): number {
  const share = Math.min(1, Math.max(0, (value - low) / (high - low)));
  return share * share * (3 - 2 * share);
}

/** The colour of the outline, where the patch runs out: bright between dark; null beside it. */
function lineOf(patch: number): readonly number[] | null {
  if (patch > 0.42 && patch < 0.58) return BRIGHT;
  return patch > 0.26 && patch < 0.74 ? DARK : null;
}

/** −0.5 .. 0.5, without visible order, alike over two points each way. */
function chance(x: number, y: number): number {
  const seed = Math.sin((x >> 1) * 12.9898 + (y >> 1) * 78.233) * 43758.5453;
  return seed - Math.floor(seed) - 0.5;
}

/** The landscape's colours without its shapes: drawn small and enlarged again. */
function blurred(
  landscape: CanvasImageSource,
  width: number,
  height: number,
  columns: number,
  rows: number,
): Uint8ClampedArray {
  const small = brushOn(columns, rows);
  const large = brushOn(width, height);
  if (!small || !large) return new Uint8ClampedArray(4 * width * height);
  small.imageSmoothingQuality = "high";
  small.drawImage(landscape, 0, 0, columns, rows);
  large.imageSmoothingQuality = "high";
  large.drawImage(small.canvas, 0, 0, width, height);
  return large.getImageData(0, 0, width, height).data;
}

function brushOn(width: number, height: number): CanvasRenderingContext2D | null {
  const canvas = document.createElement("canvas");
  canvas.width = width;
  canvas.height = height;
  return canvas.getContext("2d", { willReadFrequently: true });
}
