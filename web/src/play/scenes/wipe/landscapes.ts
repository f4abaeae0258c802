// The landscapes behind the mist, one after the other.
import { type CanvasTexture, LinearMipmapLinearFilter } from "three";
import { painted } from "../../textures";
import { blossom } from "./pictures/blossom";
import { harbour } from "./pictures/harbour";
import { lanterns } from "./pictures/lanterns";
import { mountains } from "./pictures/mountains";
import { river } from "./pictures/river";

const LANDSCAPES = [mountains, river, harbour, blossom, lanterns] as const;
/** Powers of two, so that a blurred likeness can be made of it. */
const WIDTH = 1024;
const HEIGHT = 512;

let shown = -1;

/** Another landscape than the one before; the first is chosen by a number. */
export function nextLandscape(number: number): CanvasTexture {
  shown = (shown < 0 ? number : shown + 1) % LANDSCAPES.length;
  const texture = painted(WIDTH, HEIGHT, LANDSCAPES[shown] ?? mountains);
  texture.generateMipmaps = true;
  texture.minFilter = LinearMipmapLinearFilter;
  return texture;
}
