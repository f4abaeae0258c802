// Steep green hills on a quiet river, a raft with its lantern, cranes in the air.
import { type Brush, chance, fade, glow, HEIGHT, ripples, shape, spot, WIDTH } from "./brush";

const SHORE = 340;
const HILLS: readonly (readonly [x: number, wide: number, top: number, color: string])[] = [
  [120, 130, 120, "#b9d4cf"],
  [360, 110, 90, "#aecdc6"],
  [600, 140, 150, "#b4d2cb"],
  [860, 150, 100, "#a6c8bf"],
  [20, 150, 190, "#7fb3a0"],
  [250, 120, 170, "#74ab96"],
  [980, 150, 160, "#6ea58e"],
  [720, 110, 210, "#82b6a0"],
];

export function river(brush: Brush): void {
  fade(brush, 0, SHORE, ["#f6c9a0", "#fbe3bd", "#fff6df"]);
  glow(brush, 520, 190, 240, "rgba(255,226,160,0.95)");
  brush.fillStyle = "#f58a4b";
  spot(brush, 520, 190, 46);
  for (const [x, wide, top, color] of HILLS) hill(brush, x, wide, top, color);
  fade(brush, SHORE, HEIGHT, ["#f7dcb2", "#9fc7bb", "#5f9f9b"]);
  for (const [x, wide, top, color] of HILLS.slice(4)) mirrored(brush, x, wide, top, color);
  ripples(brush, "rgba(255,250,235,0.45)", SHORE + 8, HEIGHT, 40);
  raft(brush, 620, 430);
  for (let i = 0; i < 5; i++) crane(brush, 250 + i * 52, 92 + 24 * Math.sin(i * 1.3), 20);
  bamboo(brush);
}

function hill(brush: Brush, x: number, wide: number, top: number, color: string): void {
  brush.fillStyle = color;
  brush.beginPath();
  brush.moveTo(x - wide, SHORE);
  brush.bezierCurveTo(x - wide * 0.6, SHORE - 40, x - wide * 0.5, top, x, top);
  brush.bezierCurveTo(x + wide * 0.5, top, x + wide * 0.55, SHORE - 60, x + wide, SHORE);
  brush.fill();
}

function mirrored(brush: Brush, x: number, wide: number, top: number, color: string): void {
  brush.save();
  brush.globalAlpha = 0.35;
  brush.translate(0, 2 * SHORE);
  brush.scale(1, -1);
  hill(brush, x, wide, SHORE - (SHORE - top) * 0.6, color);
  brush.restore();
}

function raft(brush: Brush, x: number, y: number): void {
  brush.fillStyle = "rgba(30,60,60,0.35)";
  spot(brush, x, y + 12, 120, 8);
  brush.fillStyle = "#9a7b45";
  for (let k = 0; k < 4; k++) brush.fillRect(x - 115 + k * 3, y - 8 + k * 4, 230, 4);
  brush.fillStyle = "#3d4a52";
  shape(brush, [
    [x - 26, y - 4],
    [x - 14, y - 66],
    [x + 10, y - 66],
    [x + 22, y - 4],
  ]);
  brush.fillStyle = "#e8c98a";
  shape(brush, [
    [x - 40, y - 66],
    [x - 2, y - 94],
    [x + 36, y - 66],
  ]);
  brush.fillStyle = "#6b5434";
  brush.fillRect(x + 40, y - 120, 4, 130);
  brush.fillStyle = "#e4513c";
  spot(brush, x + 84, y - 20, 12, 15);
}

function crane(brush: Brush, x: number, y: number, wide: number): void {
  brush.strokeStyle = "#5a6670";
  brush.lineWidth = 3.5;
  brush.beginPath();
  brush.moveTo(x - wide, y - 7);
  brush.quadraticCurveTo(x - wide * 0.4, y - 9, x, y);
  brush.quadraticCurveTo(x + wide * 0.4, y - 9, x + wide, y - 7);
  brush.stroke();
}

function bamboo(brush: Brush): void {
  for (let i = 0; i < 6; i++) {
    const x = 30 + i * 17;
    brush.fillStyle = `hsl(${100 + 12 * chance(i)} 38% ${30 + 10 * chance(i + 3)}%)`;
    brush.fillRect(x, 40 + 60 * chance(i + 7), 7, HEIGHT);
    for (let k = 0; k < 9; k++) {
      const side = k % 2 === 0 ? 1 : -1;
      spot(brush, x + side * 26 + 4, 70 + 46 * k + 20 * chance(i + k), 26, 5, side * 0.5);
    }
  }
  brush.fillStyle = "#54824f";
  spot(brush, WIDTH * 0.05, HEIGHT, 190, 36);
}
