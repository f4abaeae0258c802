// A mountain lake in the morning: snow on the peaks, firs on the shore, a red boat.
import { type Brush, chance, fade, glow, HEIGHT, ridge, ripples, shape, spot, WIDTH } from "./brush";

const SHORE = 318;

export function mountains(brush: Brush): void {
  fade(brush, 0, SHORE, ["#4f9bd9", "#a9d7ee", "#fde9c4"]);
  glow(brush, 780, 120, 190, "rgba(255,246,200,0.95)");
  brush.fillStyle = "#fff6cf";
  spot(brush, 780, 120, 36);
  peak(brush, 250, 92, 250, "#7d93b5");
  peak(brush, 560, 140, 220, "#8ba2c2");
  peak(brush, 930, 120, 240, "#8097b8");
  ridge(brush, "#7aa57c", (x) => 276 + 18 * Math.sin(x * 0.012) + 8 * Math.sin(x * 0.04), SHORE);
  for (let i = 0; i < 46; i++) fir(brush, chance(i) * WIDTH, 306 + 12 * chance(i + 90), 26 + 30 * chance(i + 50));
  fade(brush, SHORE, HEIGHT, ["#9fd0dc", "#4d9bbd", "#2d739c"]);
  ripples(brush, "rgba(255,255,255,0.35)", SHORE + 10, HEIGHT, 44);
  boat(brush, 470, 410);
}

function peak(brush: Brush, x: number, top: number, wide: number, color: string): void {
  brush.fillStyle = color;
  shape(brush, [
    [x - wide, SHORE],
    [x, top],
    [x + wide, SHORE],
  ]);
  brush.fillStyle = "#ffffff";
  const snow = 74;
  const out = (wide * snow) / (SHORE - top);
  shape(brush, [
    [x - out, top + snow],
    [x, top],
    [x + out, top + snow],
    [x + out * 0.45, top + snow * 0.72],
    [x + out * 0.1, top + snow * 1.05],
    [x - out * 0.4, top + snow * 0.7],
  ]);
}

function fir(brush: Brush, x: number, foot: number, tall: number): void {
  brush.fillStyle = `hsl(150 34% ${24 + 14 * chance(x)}%)`;
  for (let k = 0; k < 3; k++) {
    const y = foot - k * tall * 0.26;
    const wide = tall * (0.3 - 0.07 * k);
    shape(brush, [
      [x - wide, y],
      [x, y - tall * 0.5],
      [x + wide, y],
    ]);
  }
}

function boat(brush: Brush, x: number, y: number): void {
  brush.fillStyle = "rgba(20,50,70,0.35)";
  spot(brush, x, y + 20, 92, 9);
  brush.fillStyle = "#d8493c";
  shape(brush, [
    [x - 90, y - 10],
    [x + 90, y - 10],
    [x + 62, y + 18],
    [x - 66, y + 18],
  ]);
  brush.fillStyle = "#fff4e0";
  brush.fillRect(x - 90, y - 15, 180, 7);
  brush.fillStyle = "#5b4636";
  brush.fillRect(x - 4, y - 120, 6, 110);
  brush.fillStyle = "#fffaf0";
  shape(brush, [
    [x + 6, y - 118],
    [x + 72, y - 26],
    [x + 6, y - 26],
  ]);
}
