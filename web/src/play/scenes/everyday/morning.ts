// The garden as it is seen through the kitchen window, painted with a brush on a canvas of 512 by 330.

const TREES: readonly (readonly [x: number, y: number, size: number, color: string])[] = [
  [70, 196, 46, "#7fae6a"],
  [118, 204, 34, "#93bd77"],
  [400, 192, 52, "#79a866"],
  [452, 206, 38, "#8cb873"],
  [262, 214, 22, "#a3c888"],
];

export function morning(brush: CanvasRenderingContext2D): void {
  sky(brush);
  hill(brush, "#bcd8bd", 206, 18, 0.011);
  hill(brush, "#a3cb93", 226, 12, 0.017);
  for (const [x, y, size, color] of TREES) tree(brush, x, y, size, color);
  hill(brush, "#8fbe72", 262, 6, 0.02);
  flowers(brush);
}

function sky(brush: CanvasRenderingContext2D): void {
  const fade = brush.createLinearGradient(0, 0, 0, 250);
  fade.addColorStop(0, "#8fc7ea");
  fade.addColorStop(0.7, "#dff0f2");
  fade.addColorStop(1, "#fff0cf");
  brush.fillStyle = fade;
  brush.fillRect(0, 0, 512, 330);
  brush.fillStyle = "rgba(255,255,255,0.75)";
  for (const [x, y, size] of [
    [90, 150, 22],
    [120, 146, 28],
    [152, 153, 20],
    [350, 128, 24],
    [380, 123, 18],
  ] as const) {
    spot(brush, x, y, size, 0.45);
  }
}

function hill(brush: CanvasRenderingContext2D, color: string, top: number, wave: number, often: number): void {
  brush.fillStyle = color;
  brush.beginPath();
  brush.moveTo(0, 330);
  for (let x = 0; x <= 512; x += 8) brush.lineTo(x, top + wave * Math.sin(x * often + top));
  brush.lineTo(512, 330);
  brush.fill();
}

function tree(brush: CanvasRenderingContext2D, x: number, y: number, size: number, color: string): void {
  brush.fillStyle = "#8a6a4c";
  brush.fillRect(x - size * 0.06, y, size * 0.12, size * 0.9);
  brush.fillStyle = color;
  for (const [dx, dy, share] of [
    [0, 0, 0.5],
    [-0.35, 0.12, 0.36],
    [0.36, 0.1, 0.38],
    [0.05, -0.35, 0.34],
  ] as const) {
    spot(brush, x + dx * size, y + dy * size, share * size, 1);
  }
}

function flowers(brush: CanvasRenderingContext2D): void {
  for (let i = 0; i < 70; i++) {
    brush.fillStyle = ["#fff6e0", "#f6c945", "#e8758f", "#b58ad6"][i % 4] ?? "#fff6e0";
    spot(brush, (i * 0.618 * 512) % 512, 276 + ((i * 0.414 * 50) % 50), 2.6, 1);
  }
}

/** A filled circle, flattened by `flat`. */
function spot(brush: CanvasRenderingContext2D, x: number, y: number, radius: number, flat: number): void {
  brush.beginPath();
  brush.ellipse(x, y, radius, radius * flat, 0, 0, 2 * Math.PI);
  brush.fill();
}
