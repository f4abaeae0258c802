// The sea in summer: a lighthouse on its cliff, sails, gulls.
import { type Brush, chance, fade, glow, HEIGHT, ripples, shape, spot } from "./brush";

const HORIZON = 250;

export function harbour(brush: Brush): void {
  fade(brush, 0, HORIZON, ["#2f8fd8", "#86c7ee", "#e3f4f6"]);
  glow(brush, 240, 90, 170, "rgba(255,250,215,0.95)");
  brush.fillStyle = "#fffbe0";
  spot(brush, 240, 90, 34);
  for (const [x, y, size] of [
    [430, 80, 40],
    [640, 130, 30],
    [120, 170, 26],
  ] as const) {
    cloud(brush, x, y, size);
  }
  fade(brush, HORIZON, HEIGHT, ["#6fc6d8", "#2596bd", "#14679a"]);
  ripples(brush, "rgba(255,255,255,0.4)", HORIZON + 8, HEIGHT, 60);
  sail(brush, 330, 330, 120, "#e4513c");
  sail(brush, 520, 290, 70, "#f6c945");
  sail(brush, 150, 300, 60, "#ffffff");
  cliff(brush);
  lighthouse(brush, 850, 268);
  for (let i = 0; i < 7; i++) gull(brush, 470 + 60 * i * chance(i + 1), 60 + 110 * chance(i), 12 + 8 * chance(i + 5));
}

function cloud(brush: Brush, x: number, y: number, size: number): void {
  brush.fillStyle = "rgba(255,255,255,0.92)";
  for (const [dx, dy, share] of [
    [-1, 0.15, 0.6],
    [0, -0.15, 0.85],
    [0.9, 0.1, 0.65],
    [0, 0.25, 1.2],
  ] as const) {
    spot(brush, x + dx * size, y + dy * size, share * size, share * size * 0.62);
  }
}

function sail(brush: Brush, x: number, y: number, tall: number, color: string): void {
  brush.fillStyle = "rgba(10,50,80,0.3)";
  spot(brush, x, y + tall * 0.14, tall * 0.5, tall * 0.05);
  brush.fillStyle = "#6b4a32";
  shape(brush, [
    [x - tall * 0.45, y],
    [x + tall * 0.5, y],
    [x + tall * 0.32, y + tall * 0.14],
    [x - tall * 0.32, y + tall * 0.14],
  ]);
  brush.fillStyle = color;
  shape(brush, [
    [x, y - tall],
    [x + tall * 0.44, y - tall * 0.06],
    [x, y - tall * 0.06],
  ]);
  brush.fillStyle = "#fff8ea";
  shape(brush, [
    [x - tall * 0.05, y - tall * 0.9],
    [x - tall * 0.05, y - tall * 0.06],
    [x - tall * 0.36, y - tall * 0.06],
  ]);
}

function cliff(brush: Brush): void {
  brush.fillStyle = "#b98c62";
  shape(brush, [
    [640, HEIGHT],
    [700, 400],
    [745, 380],
    [770, 300],
    [840, 268],
    [960, 262],
    [1024, 240],
    [1024, HEIGHT],
  ]);
  brush.fillStyle = "#7cb55f";
  shape(brush, [
    [762, 306],
    [840, 262],
    [960, 256],
    [1024, 234],
    [1024, 268],
    [950, 290],
    [830, 296],
  ]);
  brush.fillStyle = "rgba(255,255,255,0.8)";
  for (let i = 0; i < 9; i++) spot(brush, 640 + i * 22, HEIGHT - 12 - 10 * chance(i), 26, 9);
}

function lighthouse(brush: Brush, x: number, foot: number): void {
  glow(brush, x, foot - 176, 90, "rgba(255,240,170,0.9)");
  for (let k = 0; k < 5; k++) {
    const low = foot - k * 32;
    const wide = 30 - 3 * k;
    brush.fillStyle = k % 2 === 0 ? "#ffffff" : "#d8453a";
    shape(brush, [
      [x - wide, low],
      [x + wide, low],
      [x + wide - 3, low - 32],
      [x - wide + 3, low - 32],
    ]);
  }
  brush.fillStyle = "#fff2a8";
  brush.fillRect(x - 12, foot - 186, 24, 26);
  brush.fillStyle = "#2f3e4a";
  shape(brush, [
    [x - 18, foot - 186],
    [x, foot - 208],
    [x + 18, foot - 186],
  ]);
  brush.fillStyle = "#fbf4e4";
  brush.fillRect(x + 40, foot - 44, 66, 44);
  brush.fillStyle = "#c65a3c";
  shape(brush, [
    [x + 34, foot - 44],
    [x + 73, foot - 72],
    [x + 112, foot - 44],
  ]);
}

function gull(brush: Brush, x: number, y: number, wide: number): void {
  brush.strokeStyle = "#ffffff";
  brush.lineWidth = 4;
  brush.beginPath();
  brush.moveTo(x - wide, y - 4);
  brush.quadraticCurveTo(x - wide * 0.4, y - 10, x, y);
  brush.quadraticCurveTo(x + wide * 0.4, y - 10, x + wide, y - 4);
  brush.stroke();
}
