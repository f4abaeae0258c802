// Drops that glint and run down the glass where a cell has just become clear. None where motion disturbs.
import { BufferAttribute, BufferGeometry, Color, Points, PointsMaterial } from "three";
import { glowTexture } from "../../textures";

const MOST = 60;
const LIFE_S = 0.9;
const FALL_M_S2 = 0.35;
const PER_CELL = 3;

interface Drop {
  readonly x: number;
  readonly y: number;
  age_s: number;
}

export class Sparkles {
  /** In the glass's own frame. */
  readonly points: Points<BufferGeometry, PointsMaterial>;
  private readonly places = new BufferAttribute(new Float32Array(3 * MOST), 3);
  private drops: Drop[] = [];
  private made = 0;

  constructor(private readonly spread_m: number) {
    const paint = new PointsMaterial({
      map: glowTexture(),
      color: new Color("#ffffff"),
      size: 0.035,
      transparent: true,
      depthWrite: false,
    });
    this.points = new Points(new BufferGeometry().setAttribute("position", this.places), paint);
    this.points.frustumCulled = false;
  }

  /** A cell at (x, y) of the glass has become clear. */
  spring(x: number, y: number): void {
    for (let k = 0; k < PER_CELL; k++) {
      const i = this.made++;
      const dx = (((i * 0.618) % 1) - 0.5) * this.spread_m;
      const dy = (((i * 0.414) % 1) - 0.5) * this.spread_m;
      this.drops.push({ x: x + dx, y: y + dy, age_s: -0.12 * k });
    }
    this.drops = this.drops.slice(-MOST);
  }

  animate(dt_s: number, still: boolean): void {
    for (const drop of this.drops) drop.age_s += dt_s;
    this.drops = still ? [] : this.drops.filter((drop) => drop.age_s < LIFE_S);
    this.drops.forEach((drop, i) => {
      const age_s = Math.max(0, drop.age_s);
      this.places.setXYZ(i, drop.x, drop.y - 0.5 * FALL_M_S2 * age_s * age_s, 0.008);
    });
    this.places.needsUpdate = true;
    this.points.geometry.setDrawRange(0, this.drops.length);
  }
}
