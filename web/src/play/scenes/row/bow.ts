// What moves of the boat: the lantern at the prow, which swings with the turn, and the white water beside the bow.
import {
  type BufferGeometry,
  Color,
  DoubleSide,
  Group,
  LatheGeometry,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  Vector2,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { shade } from "../../paint";
import type { Moment } from "../../scene";
import { TABLE_Y } from "../../table";
import { BOW_Z, halfWidthAt } from "./hull";
import { WATER_Y } from "./water";

const WAVE_M = 1.7;
const WAVE_STEPS = 14;
const EYES_Z = 0.16;
/** What of the water the rim hides from the eyes: their height over the water by that over the rim. */
const HIDDEN = 1.28;

export class Bow {
  readonly group = new Group();
  private readonly lantern = paperLantern();
  private readonly wave = bowWave();

  constructor() {
    this.group.add(this.lantern, this.wave);
  }

  /** `turn_rad` to the left is positive; `speed` is a share of the greatest. */
  animate({ now_s, still }: Moment, turn_rad: number, speed: number): void {
    this.lantern.rotation.z = (still ? 0 : 0.1 * Math.sin(now_s * 1.7)) - 1.4 * turn_rad;
    this.wave.visible = speed > 0.05;
    this.wave.material.opacity = 0.5 * speed;
  }
}

/** A red lantern at the prow's tip: it swings with the turn. */
function paperLantern(): Group {
  const outline = [
    [0.03, -0.09],
    [0.075, -0.06],
    [0.09, 0],
    [0.075, 0.06],
    [0.03, 0.09],
  ].map(([radius = 0, height = 0]) => new Vector2(radius, height - 0.12));
  const paper = shade(new LatheGeometry(outline, 14), new Color("#ef4a2f"));
  const group = new Group();
  group.add(new Mesh(paper, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide })));
  group.position.set(0, TABLE_Y + 0.45, BOW_Z - 0.13);
  return group;
}

/** White water along both sides of the bow, just outside of what the rim hides from the eyes; it widens backwards. */
function bowWave(): Mesh<BufferGeometry, MeshBasicMaterial> {
  const wings = [-1, 1].map((side) => {
    const wing = new PlaneGeometry(1, 1, 1, WAVE_STEPS);
    const corners = wing.getAttribute("position");
    for (let i = 0; i < corners.count; i++) {
      const back = 0.5 - corners.getY(i);
      const z = BOW_Z + back * WAVE_M;
      const outer = corners.getX(i) > 0 ? 0.3 * back * (1 - back) ** 0.7 : 0;
      const x = HIDDEN * (halfWidthAt(z) + 0.05) + outer;
      corners.setXYZ(i, side * x, WATER_Y + 0.012, EYES_Z + HIDDEN * (z - EYES_Z));
    }
    return wing;
  });
  const paint = new MeshBasicMaterial({ color: new Color("#f2fffb"), transparent: true, opacity: 0, side: DoubleSide });
  paint.depthWrite = false;
  return new Mesh(mergeGeometries(wings), paint);
}
