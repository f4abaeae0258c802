// The pane itself: a landscape, seen blurred through mist where it has not been wiped, and the outline of the patch.
import {
  DataTexture,
  LinearFilter,
  Mesh,
  PlaneGeometry,
  RedFormat,
  RepeatWrapping,
  RGFormat,
  ShaderMaterial,
  type Texture,
  Vector3,
  Vector4,
} from "three";
import type { Cells } from "./cells";

/** Mist clears, and the patch is marked, at this speed. */
const CHANGING_PER_S = 9;
const NOISE_SIZE = 32;
/** The hand's shadow: its reach on the glass, how dark it is there, and from how far it is seen. */
const SHADOW_M = 0.075;
const SHADOW = 0.55;
const SHADOW_FAR_M = 0.3;
const NOWHERE = new Vector3();
/** Drawn before everything that acts. */
export const BENEATH = -6;

const VERTEX = `
varying vec2 at;
void main() {
  at = uv;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

/** red: how much mist; green: whether the patch. Both are rounded off between the cells, their edges ruffled. */
const FRAGMENT = `
uniform sampler2D picture;
uniform sampler2D cells;
uniform sampler2D ruffle;
uniform vec2 grid;
uniform float shine;
uniform vec4 hand;
varying vec2 at;
void main() {
  float noise = texture2D(ruffle, at * grid * 0.22).r - 0.5;
  vec2 cell = texture2D(cells, at).rg;
  float mist = smoothstep(0.34, 0.6, cell.r + 0.34 * noise * (1.0 - abs(2.0 * cell.r - 1.0)));
  float rim = mist * (1.0 - mist) * 4.0;
  vec3 clear = texture2D(picture, at).rgb;
  vec3 blurred = texture2D(picture, at, 4.6).rgb;
  vec3 fog = mix(blurred, vec3(0.66, 0.75, 0.82), 0.7 + 0.12 * noise);
  vec3 colour = mix(clear, fog, mist) + rim * vec3(0.1, 0.13, 0.15);
  float inside = smoothstep(0.42, 0.5, cell.g);
  float edge = smoothstep(0.36, 0.44, cell.g) * (1.0 - smoothstep(0.56, 0.64, cell.g));
  float dark = smoothstep(0.24, 0.3, cell.g) * (1.0 - smoothstep(0.66, 0.74, cell.g));
  vec2 stripe = at * grid;
  float hatch = smoothstep(0.34, 0.42, abs(fract((stripe.x + stripe.y) * 0.9) - 0.5));
  colour = mix(colour, colour * 0.72, inside * mist * hatch * 0.6);
  colour = mix(colour, vec3(0.02, 0.07, 0.14), dark * 0.85);
  colour = mix(colour, vec3(1.0, 0.72, 0.1), edge);
  float shade = hand.w * (1.0 - smoothstep(0.3, 1.0, length((at - hand.xy) * grid) / hand.z));
  colour *= 1.0 - shade;
  float sweep = at.x + 0.5 * at.y - shine * 1.9 + 0.2;
  colour += vec3(0.5) * (1.0 - smoothstep(0.0, 0.16, abs(sweep)));
  gl_FragColor = vec4(colour, 1.0);
  #include <colorspace_fragment>
}`;

export class Glass {
  readonly mesh: Mesh<PlaneGeometry, ShaderMaterial>;
  private readonly shown: Float32Array;
  private readonly bytes: Uint8Array;
  private readonly cells: DataTexture;
  private readonly ruffle = noise();

  constructor(
    readonly columns: number,
    readonly rows: number,
    cell_m: number,
  ) {
    this.shown = new Float32Array(2 * columns * rows);
    this.bytes = new Uint8Array(2 * columns * rows);
    this.cells = smooth(new DataTexture(this.bytes, columns, rows, RGFormat));
    const uniforms = {
      picture: { value: null as Texture | null },
      cells: { value: this.cells },
      ruffle: { value: this.ruffle },
      grid: { value: [columns, rows] },
      shine: { value: 0 },
      hand: { value: new Vector4(0, 0, 1, 0) },
    };
    const material = new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms });
    // The arm is always before the glass, also where the hand reaches through it.
    material.depthWrite = false;
    this.mesh = new Mesh(new PlaneGeometry(columns * cell_m, rows * cell_m), material);
    this.mesh.renderOrder = BENEATH;
  }

  /** Shows another landscape, all at once as misted as it is said to be. */
  change(picture: Texture, cells: Cells): void {
    this.set("picture", picture);
    this.approach(cells, 1);
  }

  /** `shine` 0..1: how far a gleam has swept over the glass. */
  animate(dt_s: number, cells: Cells, shine: number): void {
    this.set("shine", shine);
    this.approach(cells, Math.min(1, dt_s * CHANGING_PER_S));
  }

  /** Lets the hand's shadow fall; `hand` is in the glass's own frame, null = there is none. */
  shadow(hand: Vector3 | null): void {
    const { width, height } = this.mesh.geometry.parameters;
    const away = hand ? Math.min(1, Math.abs(hand.z) / SHADOW_FAR_M) : 1;
    const cells = (SHADOW_M * (1 + 2 * away) * this.columns) / width;
    const at = hand ?? NOWHERE;
    this.set("hand", new Vector4(at.x / width + 0.5, at.y / height + 0.5, cells, SHADOW * (1 - away)));
  }

  close(): void {
    this.cells.dispose();
    this.ruffle.dispose();
  }

  private set(name: string, value: unknown): void {
    const uniform = this.mesh.material.uniforms[name];
    if (uniform) uniform.value = value;
  }

  /** Textures have their first row at the bottom. */
  private approach({ mist, patch }: Cells, share: number): void {
    for (let i = 0; i < mist.length; i++) {
      const to = 2 * ((this.rows - 1 - Math.floor(i / this.columns)) * this.columns + (i % this.columns));
      this.move(to, mist[i] ?? 0, share);
      this.move(to + 1, patch[i] ? 1 : 0, share);
    }
    this.cells.needsUpdate = true;
  }

  private move(i: number, wanted: number, share: number): void {
    const next = (this.shown[i] ?? 0) + (wanted - (this.shown[i] ?? 0)) * share;
    this.shown[i] = next;
    this.bytes[i] = Math.round(255 * next);
  }
}

function smooth(texture: DataTexture): DataTexture {
  texture.magFilter = LinearFilter;
  texture.minFilter = LinearFilter;
  // Rows of two bytes a cell are not multiples of four.
  texture.unpackAlignment = 1;
  return texture;
}

/** Values that look without order, the same every time. */
function noise(): DataTexture {
  const bytes = new Uint8Array(NOISE_SIZE * NOISE_SIZE);
  for (let i = 0; i < bytes.length; i++) bytes[i] = Math.floor(((Math.sin(i * 12.9898) * 43758.5453) % 1) * 127 + 128);
  const texture = smooth(new DataTexture(bytes, NOISE_SIZE, NOISE_SIZE, RedFormat));
  texture.wrapS = RepeatWrapping;
  texture.wrapT = RepeatWrapping;
  texture.needsUpdate = true;
  return texture;
}
