// Spring: a pavilion by a pond, blossoming trees, a snow-topped mountain far away.
import { type Brush, chance, fade, HEIGHT, ridge, ripples, shape, spot, WIDTH } from "./brush";

const SHORE = 350;
const PINKS = ["#ffd3e0", "#ffb7ce", "#f893b5", "#fff0f4"] as const;

export function blossom(brush: Brush): void {
  fade(brush, 0, SHORE, ["#8fc9ef", "#cfe9f5", "#fdeff0"]);
  mountain(brush);
  ridge(brush, "#9ccf9a", (x) => 300 + 14 * Math.sin(x * 0.011 + 1), SHORE);
  ridge(brush, "#7fbd7d", (x) => 326 + 9 * Math.sin(x * 0.02), SHORE);
  fade(brush, SHORE, HEIGHT, ["#bfe3ea", "#74bcd0", "#4796b3"]);
  ripples(brush, "rgba(255,255,255,0.45)", SHORE + 8, HEIGHT, 34);
  pavilion(brush, 650, 346);
  tree(brush, 170, 372, 1.15);
  tree(brush, 930, 366, 0.95);
  for (let i = 0; i < 70; i++) petal(brush, i);
  lilies(brush);
}

function mountain(brush: Brush): void {
  brush.fillStyle = "#8fa9cf";
  shape(brush, [
    [160, SHORE],
    [420, 96],
    [470, 96],
    [760, SHORE],
  ]);
  brush.fillStyle = "#ffffff";
  shape(brush, [
    [340, 175],
    [420, 96],
    [470, 96],
    [558, 175],
    [520, 166],
    [488, 190],
    [446, 164],
    [408, 192],
    [380, 164],
  ]);
}

function pavilion(brush: Brush, x: number, foot: number): void {
  brush.fillStyle = "#b5432f";
  for (const dx of [-74, -28, 28, 74]) brush.fillRect(x + dx - 5, foot - 86, 10, 86);
  brush.fillStyle = "#7a4a33";
  brush.fillRect(x - 96, foot - 8, 192, 14);
  for (const [y, wide, tall] of [
    [foot - 84, 132, 44],
    [foot - 124, 88, 44],
  ] as const) {
    brush.fillStyle = "#3f5d6b";
    brush.beginPath();
    brush.moveTo(x - wide, y - 6);
    brush.quadraticCurveTo(x - wide * 0.5, y - 8, x - wide * 0.32, y - tall);
    brush.lineTo(x + wide * 0.32, y - tall);
    brush.quadraticCurveTo(x + wide * 0.5, y - 8, x + wide, y - 6);
    brush.lineTo(x + wide * 0.8, y + 4);
    brush.lineTo(x - wide * 0.8, y + 4);
    brush.fill();
  }
  brush.fillStyle = "#f6c945";
  spot(brush, x, foot - 174, 8, 11);
}

function tree(brush: Brush, x: number, foot: number, size: number): void {
  brush.strokeStyle = "#6a4a3e";
  brush.lineCap = "round";
  for (const [dx, dy, wide] of [
    [0, -150, 22],
    [-90, -190, 11],
    [96, -180, 11],
    [30, -240, 9],
  ] as const) {
    brush.lineWidth = wide * size;
    brush.beginPath();
    brush.moveTo(x, foot);
    brush.quadraticCurveTo(x, foot - 90 * size, x + dx * size, foot + dy * size);
    brush.stroke();
  }
  for (let i = 0; i < 90; i++) {
    brush.fillStyle = PINKS[i % PINKS.length] ?? "#ffd3e0";
    const around = i * 2.4;
    const out = Math.sqrt(chance(i)) * 150 * size;
    spot(
      brush,
      x + Math.cos(around) * out,
      foot - 210 * size + Math.sin(around) * out * 0.62,
      (14 + 16 * chance(i + 9)) * size,
    );
  }
}

function petal(brush: Brush, i: number): void {
  brush.fillStyle = PINKS[i % PINKS.length] ?? "#ffd3e0";
  spot(brush, chance(i) * WIDTH, 150 + chance(i + 30) * 350, 6, 3, chance(i + 60) * 3);
}

function lilies(brush: Brush): void {
  for (let i = 0; i < 12; i++) {
    const x = 60 + chance(i + 5) * 900;
    const y = 400 + chance(i + 12) * 95;
    brush.fillStyle = "#4f9a66";
    spot(brush, x, y, 34, 10);
    if (i % 2 === 0) continue;
    brush.fillStyle = "#ffe3ee";
    spot(brush, x + 4, y - 9, 12, 9);
  }
}
