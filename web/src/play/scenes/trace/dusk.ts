// What acts at the lake: the path that lies there, its lantern, the flower at its end, and the lanterns brought home.
import { Group, type Scene, Vector3 } from "three";
import type { Changes, GameView, ThingView } from "../../changes";
import { dispose } from "../../dispose";
import type { GameScene, Moment } from "../../scene";
import type { Tone } from "../../sound";
import { Fleet } from "./fleet";
import { Flower } from "./flower";
import { Lantern } from "./lantern";
import { Ribbon } from "./ribbon";

/** High bells after the two notes of a success, for a light that was hardly left. */
const STEADY: readonly Tone[] = [
  { after_s: 0.24, pitch_hz: 1174.66, ring_s: 1.4 },
  { after_s: 0.36, pitch_hz: 1567.98, ring_s: 1.8 },
];

/** One path with all that belongs to it. */
class Path {
  readonly group = new Group();
  private readonly ribbon: Ribbon;
  private readonly lantern: Lantern;
  private readonly flower: Flower;

  constructor(
    way: GameView["way"],
    private light: ThingView,
    private end: ThingView,
  ) {
    this.ribbon = new Ribbon(
      way.map((point) => new Vector3(...point)),
      light.radius_m,
    );
    this.lantern = new Lantern(light);
    this.flower = new Flower(end);
    this.group.add(this.ribbon.group, this.lantern.group, this.flower.group);
  }

  get id(): number {
    return this.light.id;
  }

  /** True once a path that was taken away has faded. */
  get gone(): boolean {
    return this.ribbon.gone;
  }

  show(light: ThingView, end: ThingView): void {
    this.light = light;
    this.end = end;
  }

  leave(): void {
    this.ribbon.leave();
    this.lantern.group.visible = false;
    this.flower.group.visible = false;
  }

  animate(moment: Moment): void {
    this.lantern.animate(moment, this.light);
    this.ribbon.animate(moment, this.lantern.share);
    this.flower.animate(moment, this.end);
  }
}

export class Dusk implements GameScene {
  readonly group = new Group();
  readonly tones = { steady: STEADY };
  private readonly fleet = new Fleet();
  private path: Path | null = null;
  private leaving: Path[] = [];

  constructor(readonly scenery: Scene) {
    this.group.add(this.fleet.group);
  }

  show(view: GameView, changes: Changes): readonly Vector3[] {
    const playing = view.phase === "playing" ? view.things : [];
    const light = playing.find((thing) => thing.kind === "light");
    const end = playing.find((thing) => thing.kind === "end");
    if (this.path && this.path.id !== light?.id) this.letGo(this.path);
    if (light && end) this.lay(view.way, light, end);
    const home = changes.hits > 0 ? changes.gone.find((thing) => thing.kind === "end") : undefined;
    const place = home ? new Vector3(...home.position) : null;
    this.fleet.hold(view.hits, place);
    return place ? [place] : [];
  }

  animate(moment: Moment): void {
    for (const path of this.path ? [this.path, ...this.leaving] : this.leaving) path.animate(moment);
    for (const path of this.leaving.filter((one) => one.gone)) this.remove(path);
    this.leaving = this.leaving.filter((one) => !one.gone);
    this.fleet.animate(moment);
  }

  close(): void {
    this.fleet.close();
    dispose(this.group);
    dispose(this.scenery);
  }

  private lay(way: GameView["way"], light: ThingView, end: ThingView): void {
    if (this.path) {
      this.path.show(light, end);
    } else {
      this.path = new Path(way, light, end);
      this.group.add(this.path.group);
    }
  }

  private letGo(path: Path): void {
    path.leave();
    this.leaving.push(path);
    this.path = null;
  }

  private remove(path: Path): void {
    this.group.remove(path.group);
    dispose(path.group);
  }
}
