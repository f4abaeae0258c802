// What acts at the kitchen table: the things, their stands, the goal of the moment, the egg timer.
import { Group, type Scene, Vector3 } from "three";
import type { Changes, GameView, ThingView } from "../../changes";
import { dispose } from "../../dispose";
import type { Side } from "../../hand-shape";
import type { GameScene, Moment } from "../../scene";
import { tone } from "../../sound";
import { EggTimer } from "./egg-timer";
import { Goal } from "./goal";
import { Prop } from "./prop";
import { gripOf } from "./shapes";
import { type Resting, Stands } from "./stands";
import { Stream } from "./stream";

const PROPS = new Set(["cup", "jug", "cube", "barrel", "roof"]);
/** What is held, or built with, has its stand elsewhere. */
const AT_HOME = new Set(["standing", "wanted"]);
const TILTING = new Set(["pour", "drink"]);

export class Breakfast implements GameScene {
  readonly group = new Group();
  readonly tones = {
    poured: [tone(0, 392, 0.5), tone(0.1, 440, 0.5), tone(0.2, 523.25, 0.7)],
    drunk: [tone(0, 523.25, 0.6), tone(0.14, 392, 0.9)],
    stacked: [tone(0, 220, 0.25)],
    tower: [tone(0.1, 523.25, 0.9), tone(0.25, 659.25, 0.9), tone(0.4, 783.99, 1), tone(0.55, 1046.5, 1.8)],
  };
  private readonly inward: number;
  private readonly props = new Map<number, Prop>();
  private readonly stands = new Stands();
  private readonly goal: Goal;
  private readonly stream: Stream;
  private readonly timer: EggTimer;

  constructor(
    side: Side,
    readonly scenery: Scene,
  ) {
    this.inward = side === "left" ? 1 : -1;
    this.goal = new Goal(this.inward);
    this.stream = new Stream(this.inward);
    this.timer = new EggTimer(this.inward);
    this.group.add(this.stands.group, this.timer.group, this.stream.group, this.goal.group);
  }

  show(view: GameView, changes: Changes): readonly Vector3[] {
    const playing = view.phase === "playing";
    if (playing) this.keep(view.things);
    for (const prop of this.props.values()) prop.group.visible = playing;
    this.stands.group.visible = playing;
    const find = (kind: string) => (playing ? (view.things.find((thing) => thing.kind === kind) ?? null) : null);
    this.goal.show(find("goal"), this.inHand()?.kind ?? "cup");
    this.timer.show(find("timer")?.progress ?? null);
    const done = changes.hits > 0 ? changes.gone.find((thing) => thing.kind === "goal") : undefined;
    return done ? [new Vector3(...done.position)] : [];
  }

  animate(moment: Moment): void {
    this.goal.animate(moment);
    const verb = this.goal.isReached(moment.hand) && TILTING.has(this.goal.verb) ? this.goal.verb : "";
    for (const prop of this.props.values()) prop.animate(moment, verb);
    this.stream.animate(moment, verb === "pour" ? this.placeOf("jug") : null, this.placeOf("cup"));
    this.timer.animate(moment);
  }

  close(): void {
    dispose(this.group);
    dispose(this.scenery);
  }

  /** Brings the things to what the game says; another table is set where there is another one. */
  private keep(things: readonly ThingView[]): void {
    const wanted = new Set(things.map((thing) => thing.id));
    for (const [id, prop] of this.props) if (!wanted.has(id)) this.remove(id, prop);
    const props = things.filter((thing) => PROPS.has(thing.kind));
    const fresh = props.filter((thing) => !this.props.has(thing.id));
    for (const thing of props) this.props.get(thing.id)?.show(thing);
    for (const thing of fresh) this.add(thing);
    if (fresh.length > 0)
      this.stands.carry(things.filter((thing) => AT_HOME.has(thing.state)).map((thing) => this.resting(thing)));
  }

  private add(thing: ThingView): void {
    const prop = new Prop(thing, this.inward);
    this.props.set(thing.id, prop);
    this.group.add(prop.group);
  }

  private remove(id: number, prop: Prop): void {
    this.props.delete(id);
    this.group.remove(prop.group);
    dispose(prop.group);
  }

  private resting({ kind, position }: ThingView): Resting {
    return { kind, home: new Vector3(...position).add(gripOf(this.inward)) };
  }

  private inHand(): Prop | undefined {
    return [...this.props.values()].find((prop) => prop.isHeld);
  }

  private placeOf(kind: string): Vector3 | null {
    return [...this.props.values()].find((prop) => prop.kind === kind)?.group.position ?? null;
  }
}
