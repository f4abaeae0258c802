// A feast at night: paper lanterns rise over a village by the water, under the moon.
import { type Brush, chance, fade, glow, HEIGHT, ridge, shape, spot, WIDTH } from "./brush";

const SHORE = 372;

export function lanterns(brush: Brush): void {
  fade(brush, 0, SHORE, ["#12224f", "#27407f", "#5b5f9e", "#d08a7a"]);
  for (let i = 0; i < 130; i++) star(brush, i);
  glow(brush, 800, 96, 150, "rgba(255,248,215,0.8)");
  brush.fillStyle = "#fff6d8";
  spot(brush, 800, 96, 44);
  ridge(brush, "#2c3768", (x) => 290 + 34 * Math.sin(x * 0.008) + 12 * Math.sin(x * 0.03), SHORE);
  ridge(brush, "#1f2850", (x) => 336 + 16 * Math.sin(x * 0.014 + 2), SHORE);
  for (let i = 0; i < 13; i++) house(brush, 40 + i * 78 + 20 * chance(i), SHORE, 34 + 26 * chance(i + 3), i);
  fade(brush, SHORE, HEIGHT, ["#54507f", "#26305f", "#141d45"]);
  for (let i = 0; i < 26; i++) reflection(brush, i);
  for (let i = 0; i < 17; i++) lantern(brush, i);
}

function star(brush: Brush, i: number): void {
  brush.fillStyle = `rgba(255,250,230,${0.35 + 0.6 * chance(i + 7)})`;
  spot(brush, chance(i) * WIDTH, chance(i + 40) * 270, 1 + 1.6 * chance(i + 80));
}

function house(brush: Brush, x: number, foot: number, size: number, i: number): void {
  brush.fillStyle = "#3a3358";
  brush.fillRect(x - size * 0.6, foot - size, size * 1.2, size);
  brush.fillStyle = "#57314a";
  shape(brush, [
    [x - size * 0.8, foot - size],
    [x, foot - size * 1.6],
    [x + size * 0.8, foot - size],
  ]);
  brush.fillStyle = "#ffd27a";
  brush.fillRect(x - size * 0.36, foot - size * 0.75, size * 0.26, size * 0.3);
  if (i % 3 !== 0) brush.fillRect(x + size * 0.1, foot - size * 0.75, size * 0.26, size * 0.3);
}

function lantern(brush: Brush, i: number): void {
  const x = 60 + ((i * 0.618) % 1) * 910;
  const y = 50 + ((i * 0.414 + 0.1) % 1) * 260;
  const size = 13 + 20 * chance(i + 2);
  glow(brush, x, y, size * 3, "rgba(255,180,90,0.75)");
  brush.fillStyle = i % 3 === 0 ? "#ff8a4c" : "#ffb454";
  brush.beginPath();
  brush.roundRect(x - size * 0.7, y - size, size * 1.4, size * 1.9, size * 0.45);
  brush.fill();
  brush.fillStyle = "#fff0b8";
  spot(brush, x, y + size * 0.35, size * 0.4, size * 0.5);
}

function reflection(brush: Brush, i: number): void {
  brush.fillStyle = `rgba(255,190,110,${0.25 + 0.35 * chance(i)})`;
  spot(
    brush,
    chance(i + 20) * WIDTH,
    SHORE + 12 + chance(i + 33) * (HEIGHT - SHORE - 20),
    16 + 22 * chance(i + 4),
    2.6,
  );
}
