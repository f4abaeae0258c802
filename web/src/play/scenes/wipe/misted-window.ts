// What acts at the misted window: the glass in its frame, the cloth under the hand, drops that glint.
import { type CanvasTexture, Group, type Scene, Vector3 } from "three";
import type { Changes, GameView, ThingView } from "../../changes";
import { dispose } from "../../dispose";
import { Effects } from "../../effects";
import type { GameScene, Moment } from "../../scene";
import { tone } from "../../sound";
import { type Cells, cellsOf, gridOf, NO_CELLS } from "./cells";
import { Frame } from "./frame";
import { Glass } from "./glass";
import { nextLandscape } from "./landscapes";
import { Sparkles } from "./sparkles";
import { Wiper } from "./wiper";

const GLEAM_S = 1.6;

export class MistedWindow implements GameScene {
  readonly group = new Group();
  readonly tones = {
    wiped: [tone(0, 783.99, 0.4)],
    picture: [tone(0.1, 523.25, 0.9), tone(0.25, 659.25, 0.9), tone(0.4, 783.99, 1), tone(0.55, 1046.5, 1.8)],
  };
  private readonly window = new Group();
  private readonly wiper = new Wiper();
  private readonly feast = new Effects(() => this.still);
  private glass: Glass | null = null;
  private frame: Frame | null = null;
  private sparkles: Sparkles | null = null;
  private picture: CanvasTexture | null = null;
  private pane = 0;
  private cells = NO_CELLS;
  private touch: ThingView | null = null;
  private gone: number | null = null;
  private gleam_s = GLEAM_S;
  private still = false;

  constructor(readonly scenery: Scene) {
    this.window.add(this.wiper.group);
    this.group.add(this.window, this.feast.group);
    this.group.visible = false;
  }

  show(view: GameView, changes: Changes): readonly Vector3[] {
    const playing = view.phase === "playing";
    this.group.visible = playing || this.glass !== null;
    const find = (kind: string) => (playing ? (view.things.find((thing) => thing.kind === kind) ?? null) : null);
    const pane = find("pane");
    this.touch = find("wiper");
    this.gone = find("timer")?.progress ?? null;
    if (pane) this.see(pane, view.things);
    if (view.feedback.includes("picture")) this.celebrate();
    return changes.hits > 0 ? middleOf(changes.gone.filter((thing) => thing.kind === "cell")) : [];
  }

  animate(moment: Moment): void {
    this.still = moment.still;
    const hand = moment.hand ? this.window.worldToLocal(moment.hand.clone()) : null;
    this.wiper.animate(this.touch, hand);
    this.gleam_s = Math.min(GLEAM_S, this.gleam_s + moment.dt_s);
    const swept = moment.still ? 1 : this.gleam_s / GLEAM_S;
    this.glass?.animate(moment.dt_s, this.cells, swept, this.touch ? hand : null);
    this.frame?.animate(this.gone, moment.dt_s, moment.still);
    this.sparkles?.animate(moment.dt_s, moment.still);
    this.feast.animate(moment.dt_s, moment.camera);
  }

  close(): void {
    this.glass?.close();
    this.picture?.dispose();
    dispose(this.group);
    dispose(this.scenery);
  }

  /** Takes the pane as it is now; another one shows another landscape. */
  private see(pane: ThingView, things: readonly ThingView[]): void {
    const glass = this.glass ?? this.put(pane);
    const cells = cellsOf(pane, things, (place) => this.window.worldToLocal(place));
    if (pane.id === this.pane) this.glint(glass, pane, cells);
    this.cells = cells;
    if (pane.id !== this.pane) this.change(glass, pane.id);
  }

  /** Sets up the window where the rules have laid it. */
  private put(pane: ThingView): Glass {
    const { columns, rows } = gridOf(pane);
    const cell_m = 2 * pane.radius_m;
    this.glass = new Glass(columns, rows, cell_m);
    this.frame = new Frame(columns * cell_m, rows * cell_m);
    this.sparkles = new Sparkles(cell_m);
    this.window.position.set(...pane.position);
    this.window.rotation.x = -pane.turn_rad;
    this.window.add(this.glass.group, this.frame.group, this.sparkles.points);
    this.window.updateMatrixWorld(true);
    this.frame.stand(this.corners((columns * cell_m) / 2, (rows * cell_m) / 2));
    this.group.add(this.frame.legs);
    return this.glass;
  }

  /** The frame's corners in the trunk frame. */
  private corners(right_m: number, up_m: number): Vector3[] {
    return [-1, 1].flatMap((x) =>
      [-1, 1].map((y) => this.window.localToWorld(new Vector3(x * right_m, y * up_m, -0.02))),
    );
  }

  private change(glass: Glass, pane: number): void {
    this.picture?.dispose();
    this.picture = nextLandscape(pane);
    this.pane = pane;
    glass.change(this.picture, this.cells);
  }

  /** Where mist has just gone, drops glint. */
  private glint(glass: Glass, pane: ThingView, now: Cells): void {
    now.mist.forEach((mist, i) => {
      if (mist > 0 || !((this.cells.mist[i] ?? 0) > 0)) return;
      const right = (i % glass.columns) - (glass.columns - 1) / 2;
      const up = (glass.rows - 1) / 2 - Math.floor(i / glass.columns);
      this.sparkles?.spring(2 * pane.radius_m * right, 2 * pane.radius_m * up);
    });
  }

  /** The whole landscape is seen. */
  private celebrate(): void {
    this.gleam_s = 0;
    for (const x of [-0.2, 0, 0.2]) this.feast.burst(this.window.localToWorld(new Vector3(x, 0.06, 0.02)));
  }
}

/** Where something was won: the middle of the patch that is done. */
function middleOf(cells: readonly ThingView[]): Vector3[] {
  if (cells.length === 0) return [];
  const sum = cells.reduce((total, cell) => total.add(new Vector3(...cell.position)), new Vector3());
  return [sum.divideScalar(cells.length)];
}
