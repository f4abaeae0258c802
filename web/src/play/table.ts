// The table before the patient: the plane on which shadows and rings tell how far away things are.
import { BoxGeometry, Color, CylinderGeometry, Group, Mesh, MeshBasicMaterial } from "three";
import { boardsTexture } from "./textures";

/**
 * The plane on which shadows and the guide's rings fall in every scene, whatever lies there: wood, water, a deck.
 *
 * Height of the table top in the trunk frame: low, and its near edge so far ahead that a hanging arm passes before it.
 */
export const TABLE_Y = -0.57;
const WIDTH_M = 2.2;
const DEPTH_M = 1;
const NEAR_EDGE_Z = -0.22;
const THICKNESS_M = 0.035;
const BOARD_M = 0.1;
const LEG_M = 0.5;

export function table(): Group {
  const group = new Group();
  const wood = new MeshBasicMaterial({ color: new Color("#5d3d27") });
  const top = new MeshBasicMaterial({ map: boardsTexture(DEPTH_M / BOARD_M, WIDTH_M / (2 * BOARD_M)) });
  const board = new Mesh(new BoxGeometry(WIDTH_M, THICKNESS_M, DEPTH_M), [wood, wood, top, wood, wood, wood]);
  board.position.set(0, TABLE_Y - THICKNESS_M / 2, NEAR_EDGE_Z - DEPTH_M / 2);
  group.add(board);
  for (const x of [-0.9, 0.9]) {
    const leg = new Mesh(new CylinderGeometry(0.035, 0.03, LEG_M, 10), wood);
    leg.position.set(x, TABLE_Y - THICKNESS_M - LEG_M / 2, NEAR_EDGE_Z - DEPTH_M + 0.1);
    group.add(leg);
  }
  return group;
}
