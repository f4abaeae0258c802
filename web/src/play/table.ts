// The table before the patient: the plane on which shadows and rings tell how far away things are.
import { BoxGeometry, Color, CylinderGeometry, Group, Mesh, MeshLambertMaterial } from "three";
import { boardsTexture } from "./textures";

/** Height of the table top in the trunk frame: below a hanging hand, so that no arm ever cuts through it. */
export const TABLE_Y = -0.64;
const WIDTH_M = 2;
const DEPTH_M = 1;
const NEAR_EDGE_Z = -0.1;
const THICKNESS_M = 0.035;
const BOARD_M = 0.1;
const LEG_M = 0.5;

export function table(): Group {
  const group = new Group();
  const wood = new MeshLambertMaterial({ color: new Color("#a97c4f") });
  const top = new MeshLambertMaterial({ map: boardsTexture(DEPTH_M / BOARD_M, WIDTH_M / (2 * BOARD_M)) });
  const board = new Mesh(new BoxGeometry(WIDTH_M, THICKNESS_M, DEPTH_M), [wood, wood, top, wood, wood, wood]);
  board.position.set(0, TABLE_Y - THICKNESS_M / 2, NEAR_EDGE_Z - DEPTH_M / 2);
  board.receiveShadow = true;
  group.add(board);
  for (const x of [-0.9, 0.9]) {
    const leg = new Mesh(new CylinderGeometry(0.035, 0.03, LEG_M, 10), wood);
    leg.position.set(x, TABLE_Y - LEG_M / 2, NEAR_EDGE_Z - DEPTH_M + 0.1);
    group.add(leg);
  }
  return group;
}
