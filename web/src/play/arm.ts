// The patient's affected arm as it is seen from their own eyes: sleeve, forearm, wristband and hand; or its ghost.
import { Color, Group, Matrix4, Mesh, MeshLambertMaterial, TorusGeometry, Vector3 } from "three";
import { handGeometry, ROUGH_STEP_M, type Side, WRIST_HALF_M } from "./hand-shape";
import { type ArmPose, backOfHand, forearmOf, handDirectionOf } from "./limb-line";
import { LimbTube, profile } from "./limb-tube";
import { TableShadow } from "./table-shadow";

const SKIN = new Color("#e0aa86");
const SLEEVE = new Color("#4f97bd");
const BAND = new Color("#f0ead8");
const GHOST = new Color("#ffffff");
const GHOST_GLOW = new Color("#5a6a78");
const GHOST_OPACITY = 0.45;

const WRIST: readonly [number, number] = [WRIST_HALF_M.across, WRIST_HALF_M.through];
const SKIN_PROFILE = profile([
  [0.95, 0.043, 0.042],
  [1.12, 0.045, 0.043],
  [1.32, 0.0455, 0.042],
  [1.75, 0.033, 0.027],
  [2.02, ...WRIST],
]);
const SLEEVE_PROFILE = profile([
  [-0.2, 0.001, 0.001],
  [-0.16, 0.035, 0.035],
  [-0.08, 0.058, 0.058],
  [0.1, 0.062, 0.062],
  [0.5, 0.059, 0.059],
  [0.9, 0.055, 0.054],
  [1.1, 0.057, 0.056],
  [1.3, 0.055, 0.053],
  [1.34, 0.059, 0.056],
  [1.42, 0.058, 0.055],
  [1.43, 0.05, 0.046],
  [1.4, 0.04, 0.037],
]);

/** How an arm is coloured: as flesh and cloth, or as a quiet ghost that casts no shadow. */
export type ArmLook = "solid" | "ghost";

export class Arm {
  readonly group = new Group();
  private readonly skin = new LimbTube(SKIN_PROFILE);
  private readonly sleeve = new LimbTube(SLEEVE_PROFILE);
  private readonly hand: Mesh;
  private readonly band: Mesh;
  private readonly shadow: TableShadow | null = null;

  constructor(
    readonly side: Side,
    look: ArmLook,
  ) {
    const material = look === "solid" ? flesh : ghostly;
    this.hand = new Mesh(handGeometry(side), material(SKIN));
    this.band = new Mesh(new TorusGeometry(1, 0.16, 6, 20), material(BAND));
    const skin = new Mesh(this.skin.geometry, material(SKIN));
    const sleeve = new Mesh(this.sleeve.geometry, material(SLEEVE));
    for (const part of [skin, sleeve, this.hand, this.band]) {
      // Its vertices move every frame; the bounds computed at the start would hide it.
      part.frustumCulled = false;
      part.renderOrder = look === "solid" ? 0 : 5;
      this.group.add(part);
    }
    if (look === "ghost") return;
    const roughHand = new Mesh(handGeometry(side, ROUGH_STEP_M));
    roughHand.visible = false;
    this.hand.add(roughHand);
    this.shadow = new TableShadow([skin, sleeve, roughHand]);
    this.group.add(this.shadow.group);
  }

  /** Puts the arm where its four points are in the trunk frame. */
  move(pose: ArmPose): void {
    const forearm = forearmOf(pose);
    const back = backOfHand(forearm, this.side);
    const across = forearm.clone().cross(back);
    this.skin.bend(pose, forearm, across, back);
    this.sleeve.bend(pose, forearm, across, back);
    const direction = handDirectionOf(pose);
    place(this.hand, pose.wrist, direction, backOfHand(direction, this.side));
    place(this.band, pose.wrist.clone().addScaledVector(forearm, -0.018), forearm, back);
    this.band.rotateX(Math.PI / 2);
    this.band.scale.set(WRIST_HALF_M.across * 1.12, WRIST_HALF_M.through * 1.16, 0.024);
    this.group.updateMatrixWorld();
    this.shadow?.fall();
  }
}

/** Four points of three coordinates, as the stream sends them, in one row of twelve numbers. */
export function poseOf(values: readonly number[]): ArmPose {
  const point = (i: number) => new Vector3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  return { shoulder: point(0), elbow: point(1), wrist: point(2), hand: point(3) };
}

/** Turns `part` so that its +y runs along `direction` and its +z looks along `back`. */
function place(part: Mesh, position: Vector3, direction: Vector3, back: Vector3): void {
  const across = direction.clone().cross(back);
  part.position.copy(position);
  part.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(across, direction, back));
}

function flesh(color: Color): MeshLambertMaterial {
  return new MeshLambertMaterial({ color });
}

/** Where both arms are nearly in one place the solid one wins, or the two would flicker. */
function ghostly(): MeshLambertMaterial {
  return new MeshLambertMaterial({
    color: GHOST,
    emissive: GHOST_GLOW,
    transparent: true,
    opacity: GHOST_OPACITY,
    polygonOffset: true,
    polygonOffsetFactor: 6,
    polygonOffsetUnits: 60,
  });
}
