// The pane itself: a landscape, the mist upon it, the hand's shadow, and a gleam that sweeps over it when all is clear.
import {
  AdditiveBlending,
  type CanvasTexture,
  Color,
  CustomBlending,
  Group,
  type Material,
  Mesh,
  MeshBasicMaterial,
  OneFactor,
  OneMinusSrcAlphaFactor,
  PlaneGeometry,
  ShaderMaterial,
  SrcAlphaFactor,
  type Texture,
  type Vector3,
} from "three";
import { glowTexture } from "../../textures";
import type { Cells } from "./cells";
import { MistLayer } from "./mist-layer";

/** Drawn before everything that acts: the arm is before the glass, also where the hand reaches through it. */
export const BENEATH = -9;
/** The hand's shadow: half its width on the glass, how dark it is there, and from how far it is seen. */
const SHADOW_M = 0.085;
const SHADOW = 0.6;
const SHADOW_FAR_M = 0.3;
const GLEAM_M = 0.16;

const VERTEX = `
varying vec2 at;
void main() {
  at = uv;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
/** Colours as they are on the canvas, without the way to linear light and back: half the work where a processor draws. */
const FRAGMENT = `
uniform sampler2D landscape;
uniform sampler2D mist;
varying vec2 at;
void main() {
  vec4 fog = texture2D(mist, at);
  gl_FragColor = vec4(mix(texture2D(landscape, at).rgb, fog.rgb, fog.a), 1.0);
}`;

export class Glass {
  /** From the pane's middle: x right, y up the glass, z towards the eyes. */
  readonly group = new Group();
  private readonly layer: MistLayer;
  private readonly pane: Mesh<PlaneGeometry, ShaderMaterial>;
  private readonly shade: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private readonly gleam: Mesh<PlaneGeometry, MeshBasicMaterial>;

  constructor(
    readonly columns: number,
    readonly rows: number,
    cell_m: number,
  ) {
    this.layer = new MistLayer(columns, rows);
    const size = [columns * cell_m, rows * cell_m] as const;
    const black = { color: new Color("#000000"), map: glowTexture() };
    const uniforms = { landscape: { value: null as Texture | null }, mist: { value: this.layer.texture } };
    const paint = new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, uniforms, depthWrite: false });
    this.pane = new Mesh(new PlaneGeometry(...size), paint);
    this.shade = new Mesh(new PlaneGeometry(2, 2), early(new MeshBasicMaterial(black)));
    const shine = { map: glowTexture(), blending: AdditiveBlending, depthWrite: false, depthTest: false };
    this.gleam = new Mesh(new PlaneGeometry(GLEAM_M, size[1]), new MeshBasicMaterial({ ...shine, transparent: true }));
    this.pane.renderOrder = BENEATH;
    this.shade.renderOrder = BENEATH + 0.1;
    this.group.add(this.pane, this.shade, this.gleam);
  }

  /** Shows another landscape, all at once as misted as it is said to be. */
  change(landscape: CanvasTexture, cells: Cells): void {
    const { landscape: shown } = this.pane.material.uniforms;
    if (shown) shown.value = landscape;
    this.layer.cover(landscape.image, cells);
  }

  /** `swept` 0..1: how far a gleam has swept over the glass; `hand` in the glass's frame, null = casts no shadow. */
  animate(dt_s: number, cells: Cells, swept: number, hand: Vector3 | null): void {
    this.layer.animate(dt_s, cells);
    const { width } = this.pane.geometry.parameters;
    this.gleam.visible = swept < 1;
    this.gleam.position.x = (swept - 0.5) * (width - GLEAM_M);
    const away = hand ? Math.min(1, Math.abs(hand.z) / SHADOW_FAR_M) : 1;
    this.shade.visible = hand !== null && away < 1 && this.isOn(hand);
    if (!hand) return;
    this.shade.position.set(hand.x, hand.y, 0);
    this.shade.scale.setScalar(SHADOW_M * (1 + away));
    this.shade.material.opacity = SHADOW * (1 - away);
  }

  close(): void {
    this.layer.texture.dispose();
  }

  private isOn({ x, y }: Vector3): boolean {
    const { width, height } = this.pane.geometry.parameters;
    return Math.abs(x) < width / 2 && Math.abs(y) < height / 2;
  }
}

/** See-through and yet drawn in its turn among what is solid; the picture's own opacity is kept. */
function early<M extends Material>(material: M): M {
  material.depthWrite = false;
  material.blending = CustomBlending;
  material.blendSrc = SrcAlphaFactor;
  material.blendDst = OneMinusSrcAlphaFactor;
  material.blendSrcAlpha = OneFactor;
  material.blendDstAlpha = OneMinusSrcAlphaFactor;
  return material;
}
