// The landscapes behind the mist, one after the other.
import { type CanvasTexture, LinearFilter, NoColorSpace } from "three";
import { painted } from "../../textures";
import { blossom } from "./pictures/blossom";
import { HEIGHT, WIDTH } from "./pictures/brush";
import { harbour } from "./pictures/harbour";
import { lanterns } from "./pictures/lanterns";
import { mountains } from "./pictures/mountains";
import { river } from "./pictures/river";

const LANDSCAPES = [mountains, river, harbour, blossom, lanterns] as const;
/** About as many points as the glass has on a screen of 1280 by 720: none of them is shrunk away when it is drawn. */
const ACROSS = 704;
const DOWN = 480;

let shown = -1;

/** Another landscape than the one before; the first is chosen by a number. */
export function nextLandscape(number: number): CanvasTexture {
  shown = (shown < 0 ? number : shown + 1) % LANDSCAPES.length;
  const landscape = LANDSCAPES[shown] ?? mountains;
  const texture = painted(ACROSS, DOWN, (brush) => {
    brush.scale(ACROSS / WIDTH, DOWN / HEIGHT);
    landscape(brush);
  });
  texture.generateMipmaps = false;
  // Its colours go to the screen as they are (glass.ts).
  texture.colorSpace = NoColorSpace;
  texture.minFilter = LinearFilter;
  return texture;
}
