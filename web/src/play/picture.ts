// Everything on the patient's screen together: takes messages as they come, draws a frame when asked.
import { Vector3 } from "three";
import type { LiveMessage } from "../api/types";
import { type Changes, changesBetween, type GameView, NOTHING } from "./changes";
import { Choices } from "./choices";
import { setData } from "./dom";
import { Effects } from "./effects";
import { Guide } from "./guide";
import { Hud } from "./hud";
import { type Hands, Limbs } from "./limbs";
import { NoteBoard } from "./note";
import { Notes } from "./note-for";
import { Turn, waitForTurn } from "./one-sound";
import { Overlay } from "./overlay";
import { effortsOf, Pace } from "./pace";
import { reasonFor } from "./reason";
import type { GameScene } from "./scene";
import { SceneKeeper } from "./scene-keeper";
import { sceneOf } from "./scenes";
import { type Access, type Face, faceFor } from "./screen";
import type { Cue, Sound } from "./sound";
import { Stage } from "./stage";
import { type Visit, visitAfter } from "./visit";

const LONGEST_STEP_S = 0.1;
/** Its scenery is what is seen while nothing is played. */
const FIRST_GAME = "reach";
/** Faces on which the hand can choose; on all others the arm is held or nobody listens. */
const CHOOSING: ReadonlySet<Face> = new Set(["waiting", "playing", "rest", "break", "between"]);

export class Picture {
  private readonly stage: Stage;
  private readonly limbs: Limbs;
  private readonly scenes: SceneKeeper;
  private readonly guide = new Guide();
  private readonly stillness = matchMedia("(prefers-reduced-motion: reduce)");
  private readonly effects = new Effects(() => this.stillness.matches);
  private readonly hud: Hud;
  private readonly overlay: Overlay;
  private readonly choices: Choices;
  private readonly notes = new Notes();
  private readonly noteBoard: NoteBoard;
  private readonly turn = new Turn();
  private otherWindowSounds = true;
  private visit: Visit | null = null;
  private readonly pace: Pace;
  private newest: LiveMessage | null = null;
  private arrived_s = 0;
  private game: GameView | null = null;
  private drawn = 0;
  private last_s = 0;

  /** The canvases need WebGL 2. */
  constructor(
    private readonly page: HTMLElement,
    canvas: HTMLCanvasElement,
    backdrop: HTMLCanvasElement,
    hud: HTMLElement,
    overlay: HTMLElement,
    private readonly sound: Sound,
  ) {
    this.stage = new Stage(canvas, backdrop);
    this.pace = new Pace(effortsOf(this.stage.finest, this.stage.isSoftware), this.stage.isSoftware ? 1 : 0);
    this.stage.sharpen(this.pace.effort.pixels);
    this.scenes = new SceneKeeper(sceneOf, (scene) => this.enter(scene));
    this.limbs = new Limbs((side) => {
      this.page.dataset.side = side;
      this.scenes.want(this.game?.game ?? FIRST_GAME, side);
    });
    this.scenes.want(FIRST_GAME, this.limbs.side);
    this.hud = new Hud(hud);
    this.overlay = new Overlay(overlay);
    this.choices = new Choices(hud, (point) => this.stage.onPage(point));
    this.noteBoard = new NoteBoard(page);
    waitForTurn(() => {
      this.otherWindowSounds = false;
    });
    const parts = [this.choices.group, this.guide.group, this.scenes.group, this.limbs.group, this.effects.group];
    this.stage.scene.add(...parts);
  }

  /** Keeps a message that arrived at `now_s`. */
  take(message: LiveMessage, now_s: number): void {
    if (this.stage.isSoftware) this.pace.strain(lateTicks(this.newest, message));
    this.newest = message;
    this.arrived_s = now_s;
    this.limbs.take(message.tick, now_s);
    this.notes.take(message, now_s);
    this.visit = visitAfter(this.visit, message, now_s);
    const isSecond = this.turn.take(message, now_s);
    this.sound.cede(isSecond || this.otherWindowSounds);
    const { game } = message;
    const changes = changesBetween(this.game, game);
    if (this.game && !game) this.scenes.begin(FIRST_GAME, this.limbs.side);
    this.game = game;
    if (game) {
      this.react(game, changes);
      this.scenes.fetch(game.next_game);
    }
  }

  /** Draws the moment `now_s`, unless that is sooner than the machine can bear. */
  draw(access: Access, now_s: number): void {
    if (!this.pace.isDue(now_s)) return;
    const dt_s = Math.min(LONGEST_STEP_S, now_s - this.last_s);
    this.last_s = now_s;
    const face = this.faceNow(access, now_s);
    const hands = this.limbs.animate(now_s);
    this.animate(face, dt_s, now_s, hands);
    this.hud.show(this.game, face);
    this.noteBoard.show(this.notes.at(now_s, face));
    this.overlay.show(face, { game: this.game, visit: this.visit }, reasonFor(face, this.newest?.tick), now_s);
    this.stage.render();
    if (this.pace.frame(now_s)) this.stage.sharpen(this.pace.effort.pixels);
    this.mark(face, hands.acting);
  }

  private faceNow(access: Access, now_s: number): Face {
    const face = faceFor(access, this.newest, now_s - this.arrived_s, this.visit);
    return face === "playing" && this.scenes.isUnknown ? "noscene" : face;
  }

  /** A scene takes the stage. */
  private enter(scene: GameScene): void {
    const both = scene.bothArms === true;
    this.limbs.both = both;
    this.stage.set(scene.scenery, both ? "both" : this.limbs.side);
    if (this.game) this.scenes.show(this.game, NOTHING);
  }

  private react(view: GameView, changes: Changes): void {
    if (changes.fresh) this.scenes.begin(view.game, this.limbs.side);
    const places = this.scenes.show(view, changes);
    for (const place of places) {
      this.effects.burst(place);
      this.hud.popUp(changes.points, this.stage.onPage(place));
    }
    this.hud.announce(changes, view);
    this.listen(view, changes, places[0]?.x ?? view.hand[0]);
  }

  /** Sounds what happened at `x_m`, what all games share and the game's own words. */
  private listen(view: GameView, changes: Changes, x_m: number): void {
    const cue = cueFor(changes);
    if (cue) this.sound.play(cue, x_m);
    for (const word of view.feedback) this.sound.ring(this.scenes.current?.tones?.[word] ?? [], x_m);
  }

  private animate(face: Face, dt_s: number, now_s: number, hands: Hands): void {
    const still = this.stillness.matches;
    const { camera } = this.stage;
    const scene = this.scenes.current;
    const moment = { dt_s, now_s, hand: hands.acting, healthyHand: hands.healthy, camera, still };
    scene?.animate(moment);
    this.choices.offer(CHOOSING.has(face) ? (this.game?.choices ?? []) : [], this.game?.phase ?? "");
    this.choices.animate(moment);
    this.effects.animate(dt_s, camera);
    const isGuided = face === "waiting" || (face === "playing" && scene?.guided !== false);
    const aim = isGuided ? this.game?.aim : null;
    this.guide.lead(hands.acting, aim ? new Vector3(...aim) : null);
  }

  /** What a test, or a person looking into the page, wants to know without looking at pixels. */
  private mark(face: Face, hand: Vector3 | null): void {
    this.drawn += 1;
    const marks: Record<string, string> = {
      drawn: String(this.drawn),
      face,
      state: this.newest?.tick.state ?? "",
      game: this.game?.game ?? "",
      phase: this.game?.phase ?? "",
      score: String(this.game?.total_score ?? 0),
      scene: this.scenes.shown,
      fps: this.pace.fps.toFixed(0),
      pixels: String(this.pace.effort.pixels),
      hand: hand ? textOf(hand) : "",
    };
    for (const [name, value] of Object.entries(marks)) setData(this.page, name, value);
  }
}

/** How many ticks of the station came late between two messages. */
function lateTicks(before: LiveMessage | null, after: LiveMessage): number {
  return before ? Math.max(0, after.tick.timing.overruns - before.tick.timing.overruns) : 0;
}

/** "x y z" in metres. */
function textOf(point: Vector3): string {
  return point
    .toArray()
    .map((value) => value.toFixed(3))
    .join(" ");
}

function cueFor(changes: Changes): Cue | null {
  if (changes.entered === "rest" || changes.entered === "over" || changes.entered === "playing") return changes.entered;
  if (changes.hits > 0) return changes.streak ? "streak" : "hit";
  return null;
}
