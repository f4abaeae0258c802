// What a game's scene is: it draws what its own game says, over scenery of its own. A scene lives in a folder of the
// game's name, scenes/<game>/index.ts, which exports `open`; nothing else has to be told that it is there.
import type { Camera, Group, Scene, Vector3 } from "three";
import type { Changes, GameView } from "./changes";
import type { Side } from "./hand-shape";
import type { Tone } from "./sound";

/** One instant to draw. Places are in the patient's trunk frame (metres; x right, y up, −z ahead), as everywhere here. */
export interface Moment {
  /** Since the frame before; at most 0.1 s. */
  readonly dt_s: number;
  /** This screen's clock. */
  readonly now_s: number;
  /** The acting (affected) hand's middle as it is drawn; null where it is not known. */
  readonly hand: Vector3 | null;
  /** The healthy hand where it is, not mirrored; null where it is not seen. */
  readonly healthyHand: Vector3 | null;
  readonly camera: Camera;
  /** The patient has asked for reduced motion: nothing sways, flies or pulses. */
  readonly still: boolean;
}

/**
 * The picture of one game.
 *
 * The stage around it draws what all games share: the arms with their shadow, the way from hand to `view.aim`, petals
 * and points where something was won, choices, words, figures. Shadows and the guide's rings fall on the plane
 * y = `TABLE_Y` (table.ts): every scenery has something flat there, table, deck or water.
 */
export interface GameScene {
  /** What acts: drawn every frame, lit by the stage (one sun and sky light). Keep it to a few thousand triangles. */
  readonly group: Group;
  /** What stands still: painted once behind everything that acts, as seen from the patient's eyes. Brings its lights. */
  readonly scenery: Scene;
  /** Both arms act: the healthy one is drawn as solid as the affected one, and the eyes are in the middle. */
  readonly bothArms?: boolean;
  /** False where a dotted way from the hand to `view.aim` would say something wrong or disturb. */
  readonly guided?: boolean;
  /** What the game's own words in `view.feedback` sound like; it is heard from where the hand is. */
  readonly tones?: Readonly<Record<string, readonly Tone[]>>;
  /**
   * Takes a picture of the game and what is new in it; called for every message of the stream, never with another
   * game's picture. Returns where something was just won. Things act only while `view.phase` is "playing": in any
   * other phase there are words or choices to look at, and what would be mistaken for them is hidden.
   */
  show(view: GameView, changes: Changes): readonly Vector3[];
  /** Draws the next instant; called for every frame, also while the game waits. */
  animate(moment: Moment): void;
  /** Lets go of every geometry, material and texture that is its own (dispose.ts); the scene is never used again. */
  close(): void;
}

/** Makes a scene for a patient whose affected arm is on that side. */
export type OpenScene = (side: Side) => GameScene;
