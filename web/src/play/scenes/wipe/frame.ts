// The wooden frame that holds the glass on the table, with the bar along its lower edge that shortens with the time.
import {
  BoxGeometry,
  type BufferGeometry,
  CircleGeometry,
  Color,
  CylinderGeometry,
  Group,
  Mesh,
  MeshBasicMaterial,
  MeshLambertMaterial,
  PlaneGeometry,
  type Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { TABLE_Y } from "../../table";
import { BENEATH } from "./glass";

const BAR_M = 0.034;
const DEPTH_M = 0.03;
const WOOD = "#a8723f";
const FOOT_SHADE = "#38231a";
const LEG_M = 0.016;
const TIME_M = 0.014;
const SCARCE = 0.75;
const SPREAD = 0.36;

/** In the glass's own frame: x right, y up the glass, z towards the eyes. */
export class Frame {
  readonly group = new Group();
  /** Legs and their shadows, in the trunk frame. */
  readonly legs = new Group();
  private readonly time: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private shown = 0;

  constructor(
    private readonly width_m: number,
    height_m: number,
  ) {
    const wood = new MeshLambertMaterial({ color: new Color(WOOD) });
    wood.depthWrite = false;
    const frame = new Mesh(mergeGeometries(bars(width_m, height_m)), wood);
    frame.renderOrder = BENEATH + 1;
    this.group.add(frame);
    const track = new Mesh(
      new PlaneGeometry(width_m, TIME_M + 0.006),
      new MeshBasicMaterial({ color: new Color("#12202c") }),
    );
    this.time = new Mesh(new PlaneGeometry(1, TIME_M), new MeshBasicMaterial());
    for (const part of [track, this.time]) part.position.set(0, -(height_m + BAR_M) / 2, DEPTH_M / 2 + 0.002);
    this.time.position.z += 0.001;
    track.renderOrder = BENEATH + 2;
    this.time.renderOrder = BENEATH + 3;
    this.group.add(track, this.time);
  }

  /** Lets the frame stand: legs from its corners, given in the trunk frame, down to the table. */
  stand(corners: readonly Vector3[]): void {
    const wood = new MeshLambertMaterial({ color: new Color(WOOD), depthWrite: false });
    const shade = new MeshBasicMaterial({ color: new Color(FOOT_SHADE), depthWrite: false });
    for (const top of corners) {
      const foot = new Mesh(new CircleGeometry(0.045, 20).rotateX(-Math.PI / 2), shade);
      foot.position.set(top.x, TABLE_Y + 0.002, top.z);
      foot.renderOrder = BENEATH - 2;
      const post = new Mesh(leg(top), wood);
      post.renderOrder = BENEATH - 1;
      this.legs.add(foot, post);
    }
  }

  /** `gone` is the share of the patch's time that is over; null = none is timed. */
  animate(gone: number | null, dt_s: number, still: boolean): void {
    this.shown += ((gone ?? 0) - this.shown) * (still ? 1 : Math.min(1, dt_s * 8));
    const left = Math.max(0.001, 1 - this.shown);
    this.time.scale.x = this.width_m * left;
    this.time.position.x = (-this.width_m * (1 - left)) / 2;
    this.time.material.color.set(this.shown > SCARCE ? "#ff9a4a" : "#7fd6a2");
  }
}

function bars(width: number, height: number): BufferGeometry[] {
  const outer = width + 2 * BAR_M;
  return [
    new BoxGeometry(outer, BAR_M, DEPTH_M).translate(0, (height + BAR_M) / 2, 0),
    new BoxGeometry(outer, BAR_M, DEPTH_M).translate(0, -(height + BAR_M) / 2, 0),
    new BoxGeometry(BAR_M, height, DEPTH_M).translate(-(width + BAR_M) / 2, 0, 0),
    new BoxGeometry(BAR_M, height, DEPTH_M).translate((width + BAR_M) / 2, 0, 0),
  ];
}

function leg(top: Vector3): BufferGeometry {
  const height_m = Math.max(0.01, top.y - TABLE_Y);
  return new CylinderGeometry(LEG_M * (1 - SPREAD), LEG_M, height_m, 10).translate(top.x, top.y - height_m / 2, top.z);
}
