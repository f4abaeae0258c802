// The frame around the scene: the patient's eyes, the painted backdrop, screen sizes, fewer pixels on slow screens.
import {
  Color,
  DirectionalLight,
  HemisphereLight,
  type Object3D,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Side } from "./hand-shape";
import { SUN_DIRECTION } from "./table-shadow";

/**
 * A little above and behind the real eyes and on the acting arm's side, so that the whole forearm, what it reaches for
 * and the table beneath are in view. Trunk frame, for a right arm; mirrored for a left one.
 */
const EYES_IN_TRUNK = new Vector3(0.07, 0.38, 0.16);
/** The lower edge of every picture, so that a tall screen shows more sky and not the patient's lap. */
const LOWEST_SIGHT_RAD = (67.5 * Math.PI) / 180;
const HEIGHT_RAD = (71 * Math.PI) / 180;
/** On narrow screens the picture keeps at least this width. */
const LEAST_WIDTH_RAD = (74 * Math.PI) / 180;
const FINEST_PIXELS = 1.5;

export class Stage {
  /** What acts: drawn every frame. */
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(71, 1, 0.05, 120);
  private readonly renderer: WebGLRenderer;
  /** The processor draws, on which the station may run too. */
  readonly isSoftware = drawsInSoftware();
  private pixels: number;
  private scenery = new Scene();

  /**
   * The scenery is painted once onto `backdrop`, behind the see-through `canvas`: the eyes never move and nothing acts
   * behind it, and so a screen without a graphics card has two thirds less to compute.
   */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly backdrop: HTMLCanvasElement,
  ) {
    this.pixels = this.finest;
    // Smooth edges cost a processor more than they are worth.
    const antialias = !this.isSoftware;
    const powerPreference = "high-performance";
    this.renderer = new WebGLRenderer({ canvas, antialias, alpha: true, stencil: true, powerPreference });
    this.scene.add(...lights());
    addEventListener("resize", () => this.fit());
    this.fit();
  }

  /** Shows another scenery, seen from where an arm of that side is well in view, or both arms equally. */
  set(scenery: Scene, side: Side | "both"): void {
    this.scenery = scenery;
    this.camera.position.copy(EYES_IN_TRUNK);
    this.camera.position.x *= { left: -1, both: 0, right: 1 }[side];
    this.camera.updateMatrixWorld();
    this.paintBackdrop();
  }

  render(): void {
    this.renderer.render(this.scene, this.camera);
  }

  /** Pixels per pixel of the page, each way, at which the picture is as sharp as it needs to be. */
  get finest(): number {
    return this.isSoftware ? 1 : Math.min(devicePixelRatio, FINEST_PIXELS);
  }

  /** Draws what acts with so many pixels; the scenery stays as it is. */
  sharpen(pixels: number): void {
    this.pixels = pixels;
    this.resize(pixels);
  }

  /** Where a point of the trunk frame appears, in pixels of the page. */
  onPage(point: Vector3): { x: number; y: number } {
    const seen = point.clone().project(this.camera);
    return { x: ((seen.x + 1) / 2) * this.canvas.clientWidth, y: ((1 - seen.y) / 2) * this.canvas.clientHeight };
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.camera.aspect = width / height;
    const wideEnough_rad = 2 * Math.atan(Math.tan(LEAST_WIDTH_RAD / 2) / this.camera.aspect);
    const height_rad = Math.max(HEIGHT_RAD, wideEnough_rad);
    this.camera.fov = (height_rad * 180) / Math.PI;
    this.camera.rotation.set(height_rad / 2 - LOWEST_SIGHT_RAD, 0, 0);
    this.camera.updateProjectionMatrix();
    this.paintBackdrop();
  }

  private paintBackdrop(): void {
    this.resize(Math.min(devicePixelRatio, FINEST_PIXELS));
    this.backdrop.width = this.canvas.width;
    this.backdrop.height = this.canvas.height;
    this.renderer.render(this.scenery, this.camera);
    this.backdrop.getContext("2d")?.drawImage(this.canvas, 0, 0);
    this.resize(this.pixels);
  }

  private resize(pixels: number): void {
    this.renderer.setPixelRatio(pixels);
    this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
  }
}

/** Soft light from everywhere and one sun. */
function lights(): Object3D[] {
  const sun = new DirectionalLight(new Color("#fff0d8"), 2.3);
  sun.position.copy(SUN_DIRECTION);
  return [sun, new HemisphereLight(new Color("#dff0ff"), new Color("#a9926c"), 1.9)];
}

/** Whether pictures are computed without a graphics card. */
function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const renderer = gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  return /swiftshader|llvmpipe|software|basic render/i.test(renderer);
}
