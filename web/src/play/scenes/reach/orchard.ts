// The fruits of the moment: made, moved and let go as the pictures of the game say.
import { Group, type Scene, Vector3 } from "three";
import type { Changes, GameView } from "../../changes";
import { dispose } from "../../dispose";
import type { GameScene, Moment } from "../../scene";
import { Target } from "./target";

export class Orchard implements GameScene {
  readonly group = new Group();
  private readonly targets = new Map<number, Target>();
  private leaving: Target[] = [];

  constructor(readonly scenery: Scene) {}

  show(view: GameView, changes: Changes): readonly Vector3[] {
    const playing = view.phase === "playing" ? view.things : [];
    // Of several that went at once, the ones held longest were the ones reached.
    const byProgress = [...changes.gone].sort((a, b) => b.progress - a.progress);
    const reached = byProgress.slice(0, changes.hits).map((gone) => new Vector3(...gone.position));
    const wanted = new Set(playing.map((thing) => thing.id));
    for (const [id, target] of this.targets) {
      if (!wanted.has(id)) this.letGo(id, target, isAmong(reached, target.position));
    }
    for (const one of playing) {
      const known = this.targets.get(one.id);
      if (known) known.show(one);
      else this.add(one.id, new Target(one));
    }
    return reached;
  }

  animate({ dt_s, hand, camera, still }: Moment): void {
    for (const target of [...this.targets.values(), ...this.leaving]) target.animate(dt_s, hand, camera, still);
    for (const target of this.leaving.filter((one) => one.gone)) this.remove(target);
    this.leaving = this.leaving.filter((one) => !one.gone);
  }

  close(): void {
    dispose(this.group);
    dispose(this.scenery);
  }

  private add(id: number, target: Target): void {
    this.targets.set(id, target);
    this.group.add(target.group);
  }

  private letGo(id: number, target: Target, reached: boolean): void {
    target.leave(reached);
    this.targets.delete(id);
    this.leaving.push(target);
  }

  private remove(target: Target): void {
    this.group.remove(target.group);
    dispose(target.group);
  }
}

function isAmong(places: readonly Vector3[], place: Vector3): boolean {
  return places.some((one) => one.distanceTo(place) < 1e-6);
}
