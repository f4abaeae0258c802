// Blossom petals that sail by on the breeze; none where motion disturbs.
import { BufferAttribute, BufferGeometry, Color, Group, Points, PointsMaterial } from "three";
import type { Moment } from "../../scene";
import { glowTexture } from "../../textures";

const COUNT = 26;
const DEEP_M = 4;
const FALL_M = 1.5;

export class Petals {
  readonly group = new Group();
  private readonly places = new BufferAttribute(new Float32Array(3 * COUNT), 3);

  constructor() {
    const geometry = new BufferGeometry().setAttribute("position", this.places);
    const material = new PointsMaterial({ map: glowTexture(), color: new Color("#ffe3ec"), size: 0.05 });
    material.transparent = true;
    material.depthWrite = false;
    const points = new Points(geometry, material);
    points.frustumCulled = false;
    this.group.add(points);
  }

  animate({ now_s, still }: Moment): void {
    this.group.visible = !still;
    if (still) return;
    for (let i = 0; i < COUNT; i++) {
      const fallen = (i * 0.618 + now_s * (0.05 + 0.02 * ((i * 0.37) % 1))) % 1;
      const across = ((i * 0.414 + 0.04 * now_s) % 1) * 2 - 1;
      const away = 0.9 + DEEP_M * ((i * 0.731) % 1);
      const x = across * (1 + away * 0.9) + 0.12 * Math.sin(now_s + i);
      this.places.setXYZ(i, x, 0.6 - FALL_M * fallen, -away);
    }
    this.places.needsUpdate = true;
  }
}
