// What acts in catching: the butterfly that comes, its landing place, those that were caught, petals on the breeze.
import { Group, type Scene, Vector3 } from "three";
import type { Changes, GameView, ThingView } from "../../changes";
import { dispose } from "../../dispose";
import type { GameScene, Moment } from "../../scene";
import { tone } from "../../sound";
import { Flight, numberOf } from "./flight";
import { Flock } from "./flock";
import { Landing } from "./landing";
import { Petals } from "./petals";

export class Terrace implements GameScene {
  readonly group = new Group();
  readonly tones = { in_time: [tone(0.2, 1046.5, 1.4)] };
  private readonly flock = new Flock();
  private readonly petals = new Petals();
  private readonly flights = new Map<number, Flight>();
  private readonly landings = new Map<number, Landing>();
  private leaving: Flight[] = [];

  constructor(readonly scenery: Scene) {
    this.group.add(this.flock.group, this.petals.group);
  }

  show(view: GameView, changes: Changes): readonly Vector3[] {
    const caught = changes.hits > 0 ? changes.gone.find((thing) => thing.kind === "place") : undefined;
    const place = caught ? new Vector3(...caught.position) : null;
    this.flock.hold(view.hits, caught && place ? { place, number: numberOf(caught.id) } : null);
    this.fly(
      view.things.filter((thing) => thing.kind === "butterfly"),
      place !== null,
    );
    this.announce(view.things.filter((thing) => thing.kind === "place"));
    return place ? [place] : [];
  }

  animate(moment: Moment): void {
    for (const one of [...this.flights.values(), ...this.leaving]) one.animate(moment);
    for (const one of this.landings.values()) one.animate(moment);
    for (const one of this.leaving.filter((flight) => flight.isGone)) this.remove(one.group);
    this.leaving = this.leaving.filter((flight) => !flight.isGone);
    this.flock.animate(moment);
    this.petals.animate(moment);
  }

  close(): void {
    dispose(this.group);
    dispose(this.scenery);
  }

  private fly(things: readonly ThingView[], caught: boolean): void {
    for (const [id, flight] of this.flights) {
      if (things.some((thing) => thing.id === id)) continue;
      this.flights.delete(id);
      if (caught) {
        this.remove(flight.group);
        continue;
      }
      flight.leave();
      this.leaving.push(flight);
    }
    for (const thing of things) {
      const known = this.flights.get(thing.id);
      if (known) known.show(thing);
      else this.flights.set(thing.id, this.added(new Flight(thing)));
    }
  }

  private announce(things: readonly ThingView[]): void {
    for (const [id, landing] of this.landings) {
      if (things.some((thing) => thing.id === id)) continue;
      this.landings.delete(id);
      this.remove(landing.group);
    }
    for (const thing of things) {
      const known = this.landings.get(thing.id);
      if (known) known.show(thing);
      else this.landings.set(thing.id, this.added(new Landing(thing)));
    }
  }

  private added<T extends { readonly group: Group }>(one: T): T {
    this.group.add(one.group);
    return one;
  }

  private remove(group: Group): void {
    this.group.remove(group);
    dispose(group);
  }
}
