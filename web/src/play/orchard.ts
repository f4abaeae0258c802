// The targets of the moment: made, moved and let go as the pictures of the game say.
import { type Camera, Group, Vector3 } from "three";
import type { Changes, GameView } from "./changes";
import { dispose } from "./dispose";
import { Target } from "./target";

export class Orchard {
  readonly group = new Group();
  private readonly targets = new Map<number, Target>();
  private leaving: Target[] = [];

  /** Takes a picture and what changed with it; says where fruits were just reached. */
  show(view: GameView | null, changes: Changes): Vector3[] {
    const playing = view?.phase === "playing" ? view.targets : [];
    // Of several that went at once, the ones held longest were the ones reached.
    const byProgress = [...changes.gone].sort((a, b) => b.progress - a.progress);
    const reached = byProgress.slice(0, changes.hits).map((gone) => new Vector3(...gone.position));
    const wanted = new Set(playing.map((target) => target.id));
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

  /** The target nearest to `hand`, or any one. */
  nearest(hand: Vector3 | null): Vector3 | null {
    const places = [...this.targets.values()].map((target) => target.position);
    if (!hand) return places[0] ?? null;
    return places.reduce<Vector3 | null>(
      (best, one) => (best && best.distanceTo(hand) <= one.distanceTo(hand) ? best : one),
      null,
    );
  }

  animate(dt_s: number, hand: Vector3 | null, camera: Camera, still: boolean): void {
    for (const target of [...this.targets.values(), ...this.leaving]) target.animate(dt_s, hand, camera, still);
    for (const target of this.leaving.filter((one) => one.gone)) this.remove(target);
    this.leaving = this.leaving.filter((one) => !one.gone);
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
