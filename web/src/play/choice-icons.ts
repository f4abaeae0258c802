// The signs in the choices: each is another shape, and a word stands beneath it.
import { type CanvasTexture, Color, Sprite, SpriteMaterial } from "three";
import { painted } from "./textures";

export const CHOICES = ["start", "go_on", "pause", "next", "rest", "quit"] as const;
export type ChoiceId = (typeof CHOICES)[number];

/** Outlines in a square of 24 units. */
const SIGNS: Readonly<Record<ChoiceId, string>> = {
  start: "M8 5 19 12 8 19Z",
  go_on: "M8 5 19 12 8 19Z",
  pause: "M7 5h4v14H7ZM13 5h4v14h-4Z",
  next: "M4 5 12 12 4 19ZM12 5 20 12 12 19Z",
  rest: "M7 5h4v14H7ZM13 5h4v14h-4Z",
  quit: "M6 6h12v12H6Z",
};
const PAPER = "#ffffff";
const INK = "#16303f";
const SIDE_PX = 128;
const RIM_PX = 6;

/** A round sign of radius 1 that looks towards the eyes. */
export function choiceSign(id: ChoiceId): Sprite {
  const material = new SpriteMaterial({ map: sign(id), color: new Color(PAPER), depthTest: false });
  const sprite = new Sprite(material);
  sprite.scale.setScalar(2);
  return sprite;
}

function sign(id: ChoiceId): CanvasTexture {
  return painted(SIDE_PX, SIDE_PX, (brush) => {
    const middle = SIDE_PX / 2;
    brush.fillStyle = PAPER;
    brush.strokeStyle = INK;
    brush.lineWidth = RIM_PX;
    brush.beginPath();
    brush.arc(middle, middle, middle - RIM_PX, 0, 2 * Math.PI);
    brush.fill();
    brush.stroke();
    brush.scale(SIDE_PX / 48, SIDE_PX / 48);
    brush.translate(12, 12);
    brush.fillStyle = INK;
    brush.fill(new Path2D(SIGNS[id]));
  });
}
