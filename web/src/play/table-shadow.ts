// Shadows on the table top, straight beneath what casts them. Flat projections, which cost next to nothing where
// shadow maps halve the frame rate of a screen without a graphics card.
import { Color, Group, type Mesh, Plane, Vector3, Vector4 } from "three";
import { ShadowMesh } from "three/addons/objects/ShadowMesh.js";
import { TABLE_Y } from "./table";

/** Towards the sun: nearly overhead, so that a shadow tells where on the table its owner is. */
export const SUN_DIRECTION = new Vector3(0.14, 1, 0.06).normalize();

/** So much above the wood that the two never flicker. */
const LIFT_M = 0.002;
const SHADE = new Color("#0d0602");
const DARKNESS = 0.55;
const BENEATH_ALL = -2;

/** The shadows of a few meshes. */
export class TableShadow {
  readonly group = new Group();
  private readonly plane = new Plane(new Vector3(0, 1, 0), TABLE_Y + LIFT_M);
  private readonly sun = new Vector4(...SUN_DIRECTION.toArray(), 0);
  private readonly shadows: ShadowMesh[];

  constructor(casting: readonly Mesh[]) {
    this.shadows = casting.map((mesh) => {
      const shadow = new ShadowMesh(mesh);
      shadow.material.color.copy(SHADE);
      shadow.material.opacity = DARKNESS;
      shadow.renderOrder = BENEATH_ALL;
      this.group.add(shadow);
      return shadow;
    });
  }

  /** Lets the shadows fall anew, after what casts them has moved. */
  fall(): void {
    for (const shadow of this.shadows) shadow.update(this.plane, this.sun);
  }
}
