// The choices in space: a round sign where the hand is to stay, a ring that fills meanwhile, and a word beneath.
import { type Camera, Group, Vector3 } from "three";
import { isKey, type Key, t } from "../strings";
import type { ChoiceView } from "./changes";
import { CHOICES, type ChoiceId, choiceSign } from "./choice-icons";
import { dispose } from "./dispose";
import { child, setText } from "./dom";
import { DwellRing, gapTo } from "./dwell-ring";
import type { Moment } from "./scene";

/** While a game is played its pause keeps quiet until the hand is as near as this. */
const QUIET_BEYOND_M = 0.12;
const QUIET = 0.6;
const SIGN_SHARE = 0.86;

/** On which side of its sign a word stands. */
type Beside = "left" | "beneath" | "right";
const DIRECTIONS: Readonly<Record<Beside, Vector3>> = {
  left: new Vector3(-1, 0, 0),
  beneath: new Vector3(0, -1, 0),
  right: new Vector3(1, 0, 0),
};
/** From the sign's middle, in radii: clear of the ring that fills. */
const WORD_OFF = 1.5;

/** Where a point of the trunk frame is on the page, in pixels. */
export type OnPage = (point: Vector3) => { readonly x: number; readonly y: number };

class Choice {
  readonly group = new Group();
  private readonly ring = new DwellRing();
  private readonly sign;
  private readonly label: HTMLElement;
  private readonly place: Vector3;

  constructor(
    private view: ChoiceView & { readonly id: ChoiceId },
    root: HTMLElement,
  ) {
    this.place = new Vector3(...view.position);
    this.sign = choiceSign(view.id);
    this.sign.scale.multiplyScalar(SIGN_SHARE);
    this.sign.renderOrder = 7;
    this.group.add(this.sign, this.ring.group);
    this.group.position.copy(this.place);
    this.group.scale.setScalar(view.radius_m);
    this.label = child(root, "div", "choice");
    this.label.dataset.choice = view.id;
  }

  take(view: ChoiceView & { readonly id: ChoiceId }): void {
    this.view = view;
  }

  animate({ dt_s, hand, camera }: Moment, phase: string): void {
    const gap_m = gapTo(hand, this.place, this.view.radius_m);
    this.ring.animate(dt_s, gap_m, this.view.progress, camera);
    const quiet = phase === "playing" && gap_m > QUIET_BEYOND_M;
    this.ring.group.visible = !quiet;
    this.sign.material.opacity = quiet ? QUIET : 1;
  }

  get x_m(): number {
    return this.place.x;
  }

  /** Puts the word beside the sign on that side of it. */
  write(phase: string, beside: Beside, onPage: OnPage, camera: Camera): void {
    const off = DIRECTIONS[beside].clone().applyQuaternion(camera.quaternion);
    const at = onPage(this.place.clone().addScaledVector(off, this.view.radius_m * WORD_OFF));
    setText(this.label, t(wordOf(this.view.id, phase)));
    this.label.dataset.beside = beside;
    place(this.label, "left", at.x);
    place(this.label, "top", at.y);
  }

  remove(): void {
    this.label.remove();
    this.group.removeFromParent();
    this.sign.material.map?.dispose();
    dispose(this.group);
  }
}

export class Choices {
  readonly group = new Group();
  private readonly shown = new Map<string, Choice>();
  private phase = "";

  constructor(
    private readonly root: HTMLElement,
    private readonly onPage: OnPage,
  ) {}

  /** Offers these, and takes others away. */
  offer(views: readonly ChoiceView[], phase: string): void {
    this.phase = phase;
    const offered = views.filter(isKnown);
    for (const [key, choice] of this.shown) {
      if (offered.some((view) => keyOf(view) === key)) continue;
      choice.remove();
      this.shown.delete(key);
    }
    for (const view of offered) this.known(view).take(view);
  }

  animate(moment: Moment): void {
    const fromLeft = [...this.shown.values()].sort((a, b) => a.x_m - b.x_m);
    for (const [i, choice] of fromLeft.entries()) {
      choice.animate(moment, this.phase);
      choice.write(this.phase, besideOf(i, fromLeft.length), this.onPage, moment.camera);
    }
  }

  private known(view: ChoiceView & { readonly id: ChoiceId }): Choice {
    const there = this.shown.get(keyOf(view));
    if (there) return there;
    const choice = new Choice(view, this.root);
    this.shown.set(keyOf(view), choice);
    this.group.add(choice.group);
    return choice;
  }
}

/** Style sheets keep the word on the page; written only when it changes, since a written style is laid out anew. */
function place(label: HTMLElement, edge: "left" | "top", at_px: number): void {
  const text = `${at_px.toFixed(0)}px`;
  const name = `--${edge}`;
  if (label.style.getPropertyValue(name) !== text) label.style.setProperty(name, text);
}

/** The outer ones' words stand outside, so that words do not cover one another where a hand's reach is small. */
export function besideOf(index: number, count: number): Beside {
  if (count === 1) return "beneath";
  if (index === 0) return "left";
  return index === count - 1 ? "right" : "beneath";
}

/** A choice that has moved is another one: spots change with the workspace only. */
function keyOf(view: ChoiceView): string {
  return `${view.id} ${view.position.join(" ")} ${view.radius_m}`;
}

function isKnown(view: ChoiceView): view is ChoiceView & { id: ChoiceId } {
  return (CHOICES as readonly string[]).includes(view.id);
}

/** The word for a choice, another one where the phase gives it another meaning. */
export function wordOf(id: ChoiceId, phase: string): Key {
  const particular = `play.choice.${id}.${phase}`;
  return isKey(particular) ? particular : `play.choice.${id}`;
}
