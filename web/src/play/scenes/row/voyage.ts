// What acts in rowing: boat and paddles, the rings to row between, the water that passes and the lotus that opens.
import { Group, type Scene, Vector3 } from "three";
import type { Changes, GameView, ThingView } from "../../changes";
import { dispose } from "../../dispose";
import { Guide } from "../../guide";
import type { Side } from "../../hand-shape";
import type { GameScene, Moment } from "../../scene";
import { tone } from "../../sound";
import { Bow } from "./bow";
import { Ends } from "./ends";
import { LevelBar } from "./level-bar";
import { Lotus } from "./lotus";
import { Paddle } from "./paddle";
import { Ripples } from "./ripples";
import { Spray } from "./spray";

const FOLLOWING_PER_S = 8;
/** Farther than this in one picture is another game, not a glide. */
const JUMP_M = 3;
/** So much of a turn is seen: the hills are painted and stay. */
const TURN_SHARE = 0.4;

export class Voyage implements GameScene {
  readonly group = new Group();
  readonly bothArms = true;
  readonly tones = { even: [tone(0.2, 1174.66, 1.2), tone(0.3, 1046.5, 1.4)] };
  /** What floats about the boat. */
  private readonly water = new Group();
  private readonly bow = new Bow();
  private readonly ends = new Ends();
  private readonly bar = new LevelBar();
  /** The healthy hand's way, like the one that the stage draws for the shown hand. */
  private readonly guide = new Guide();
  private readonly lotus = new Lotus();
  private readonly ripples = new Ripples();
  private readonly spray = new Spray();
  private readonly paddles: { readonly shown: Paddle; readonly healthy: Paddle };
  private things: readonly ThingView[] = [];
  private aim: Vector3 | null = null;
  private gone_m = 0;
  private turn_rad = 0;
  private speed = 0;

  constructor(
    side: Side,
    readonly scenery: Scene,
  ) {
    const outward = side === "right" ? 1 : -1;
    this.paddles = { shown: new Paddle(outward), healthy: new Paddle(outward === 1 ? -1 : 1) };
    this.water.add(this.ripples.group, this.lotus.group);
    const parts = [this.bow, this.spray, this.bar, this.guide, this.ends];
    this.group.add(
      this.water,
      ...parts.map((part) => part.group),
      this.paddles.shown.group,
      this.paddles.healthy.group,
    );
  }

  show(view: GameView, changes: Changes): readonly Vector3[] {
    this.things = view.things;
    this.aim = view.aim ? new Vector3(-view.aim[0], view.aim[1], view.aim[2]) : null;
    const opened = changes.hits > 0 ? this.lotus.open() : [];
    return opened.map((place) => place.applyEuler(this.water.rotation));
  }

  animate(moment: Moment): void {
    const { dt_s, still } = moment;
    const boat = this.things.find((thing) => thing.kind === "boat");
    const before_m = this.gone_m;
    this.glide(boat, dt_s);
    this.bow.animate(moment, this.turn_rad, this.speed);
    this.ripples.animate(this.gone_m);
    this.lotus.animate(dt_s, this.gone_m, still);
    this.ends.animate(moment, this.things);
    this.guide.lead(moment.healthyHand, moment.healthyHand && this.aim);
    this.row(moment, boat?.state ?? "unseen");
    this.spray.animate(dt_s, this.gone_m - before_m);
  }

  close(): void {
    dispose(this.group);
    dispose(this.scenery);
  }

  /** Follows the boat smoothly between the pictures of the stream. */
  private glide(boat: ThingView | undefined, dt_s: number): void {
    if (!boat) return;
    const following = Math.min(1, FOLLOWING_PER_S * dt_s);
    const off_m = -boat.position[2] - this.gone_m;
    this.gone_m += Math.abs(off_m) > JUMP_M ? off_m : off_m * following;
    this.turn_rad += (boat.turn_rad - this.turn_rad) * following;
    this.speed += (boat.progress - this.speed) * following;
    // The patient sits in the boat: as it turns to the left, all about it turns to the right.
    this.water.rotation.y = -TURN_SHARE * this.turn_rad;
  }

  private row({ dt_s, hand, healthyHand, still }: Moment, state: string): void {
    const pulls = this.things.some((thing) => thing.kind === "catch" && thing.state === "done");
    const goes = this.things.some((thing) => thing.state === "now");
    this.bar.show(goes ? hand : null, healthyHand, state, !pulls);
    this.dip(this.paddles.shown, hand, pulls, dt_s, still);
    this.dip(this.paddles.healthy, healthyHand, pulls, dt_s, still);
  }

  private dip(paddle: Paddle, hand: Vector3 | null, pulls: boolean, dt_s: number, still: boolean): void {
    const was = paddle.isDipped;
    paddle.animate(dt_s, hand, pulls);
    if (!paddle.isDipped || !hand || still) return;
    if (!was) this.spray.enter(paddle.tip);
    this.spray.pull(paddle.tip, dt_s / 2);
  }
}
