// Strokes that all landscapes share. A canvas of 1024 by 512.

export type Brush = CanvasRenderingContext2D;
export const WIDTH = 1024;
export const HEIGHT = 512;

/** Fills from `top` to `bottom` with colours that run into one another. */
export function fade(brush: Brush, top: number, bottom: number, colors: readonly string[]): void {
  const gradient = brush.createLinearGradient(0, top, 0, bottom);
  colors.forEach((color, i) => {
    gradient.addColorStop(i / (colors.length - 1), color);
  });
  brush.fillStyle = gradient;
  brush.fillRect(0, top, WIDTH, bottom - top);
}

/** A filled ellipse. */
export function spot(brush: Brush, x: number, y: number, across: number, up = across, turn_rad = 0): void {
  brush.beginPath();
  brush.ellipse(x, y, across, up, turn_rad, 0, 2 * Math.PI);
  brush.fill();
}

/** A closed shape through points. */
export function shape(brush: Brush, points: readonly (readonly [number, number])[]): void {
  brush.beginPath();
  points.forEach(([x, y], i) => {
    if (i === 0) brush.moveTo(x, y);
    else brush.lineTo(x, y);
  });
  brush.fill();
}

/** A ridge whose upper edge follows `top(x)`, filled down to `bottom`. */
export function ridge(brush: Brush, color: string, top: (x: number) => number, bottom = HEIGHT): void {
  brush.fillStyle = color;
  brush.beginPath();
  brush.moveTo(0, bottom);
  for (let x = 0; x <= WIDTH; x += 6) brush.lineTo(x, top(x));
  brush.lineTo(WIDTH, bottom);
  brush.fill();
}

/** A soft light round a point. */
export function glow(brush: Brush, x: number, y: number, radius: number, color: string): void {
  const gradient = brush.createRadialGradient(x, y, 0, x, y, radius);
  gradient.addColorStop(0, color);
  gradient.addColorStop(1, "rgba(255,255,255,0)");
  brush.fillStyle = gradient;
  brush.fillRect(x - radius, y - radius, 2 * radius, 2 * radius);
}

/** Pale level strokes on water. */
export function ripples(brush: Brush, color: string, top: number, bottom: number, count: number): void {
  brush.fillStyle = color;
  for (let i = 0; i < count; i++) {
    const depth = ((i * 0.618) % 1) ** 1.5;
    const long = 20 + 90 * depth;
    spot(brush, (i * 0.414 * WIDTH * 1.7) % WIDTH, top + (bottom - top) * depth, long, 1 + 2 * depth);
  }
}

/** The part of a number that looks as if it were chance. */
export function chance(i: number): number {
  return Math.abs(Math.sin(i * 127.1) * 43758.5453) % 1;
}
