// The water's movement: level streaks of light that pass by as the boat goes, so that its speed is seen.
import { Color, Group, InstancedMesh, Matrix4, MeshBasicMaterial, PlaneGeometry } from "three";
import { WATER_Y } from "./water";

const COUNT = 60;
const DEPTH_M = 22;
const NEAR_M = 0.6;
/** No streak where the boat is: up to this far ahead, none nearer to the middle than that. */
const ALONGSIDE_M = 3.4;
const CLEAR_M = 0.95;

export class Ripples {
  readonly group = new Group();
  private readonly streaks: InstancedMesh;

  constructor() {
    const streak = new PlaneGeometry(1, 1);
    streak.rotateX(-Math.PI / 2);
    const material = new MeshBasicMaterial({ color: new Color("#e9fff6"), transparent: true, opacity: 0.28 });
    material.depthWrite = false;
    this.streaks = new InstancedMesh(streak, material, COUNT);
    this.streaks.frustumCulled = false;
    this.streaks.renderOrder = -6;
    this.group.add(this.streaks);
  }

  animate(gone_m: number): void {
    for (let i = 0; i < COUNT; i++) {
      const away_m = DEPTH_M * ((((i * 0.618 - gone_m / DEPTH_M) % 1) + 1) % 1) - NEAR_M;
      const x = (((i * 0.414) % 1) * 2 - 1) * (3 + Math.max(0, away_m) * 0.9);
      const beside = away_m < ALONGSIDE_M && Math.abs(x) < CLEAR_M ? Math.sign(x) * CLEAR_M : 0;
      const length_m = 0.16 + 0.05 * Math.max(0, away_m) * ((i * 0.73) % 1);
      const size = new Matrix4().makeScale(length_m, 1, 0.012 + 0.004 * Math.max(0, away_m));
      this.streaks.setMatrixAt(i, size.setPosition(x + beside, WATER_Y + 0.006, -away_m));
    }
    this.streaks.instanceMatrix.needsUpdate = true;
  }
}
