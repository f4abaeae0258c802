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
const FULL_FPS = 60;
const FINEST_PIXELS = 1.5;
/** Without a graphics card the processor draws, and the station may need it: half the frames, fewer pixels. */
const SPARING_FPS = 30;
const SPARING_PIXELS = 0.75;
const COARSEST_PIXELS = 0.5;
const COARSER = 0.75;

export class Stage {
  /** What acts: drawn every frame. */
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(71, 1, 0.05, 120);
  private readonly renderer: WebGLRenderer;
  readonly hoped_fps: number;
  /** No frame sooner than this after the last. */
  readonly leastFrame_s: number;
  private pixelRatio: number;
  private scenery = new Scene();

  /**
   * The scenery is painted once onto `backdrop`, behind the see-through `canvas`: the eyes never move and nothing acts
   * behind it, and so a screen without a graphics card has two thirds less to compute.
   */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly backdrop: HTMLCanvasElement,
  ) {
    const sparing = drawsInSoftware();
    this.hoped_fps = sparing ? SPARING_FPS : FULL_FPS;
    // Three quarters of a frame: screens do not keep time exactly.
    this.leastFrame_s = sparing ? 0.75 / SPARING_FPS : 0;
    this.pixelRatio = sparing ? SPARING_PIXELS : Math.min(devicePixelRatio, FINEST_PIXELS);
    const powerPreference = "high-performance";
    this.renderer = new WebGLRenderer({ canvas, antialias: !sparing, alpha: true, stencil: true, powerPreference });
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

  /** Draws fewer pixels for the sake of smooth movement. */
  coarsen(): void {
    this.pixelRatio = Math.max(COARSEST_PIXELS, this.pixelRatio * COARSER);
    this.resize(this.pixelRatio);
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
    this.resize(this.pixelRatio);
  }

  private resize(pixelRatio: number): void {
    this.renderer.setPixelRatio(pixelRatio);
    this.renderer.setSize(this.canvas.clientWidth, this.canvas.clientHeight, false);
  }
}

/** Soft light from everywhere and one sun. */
function lights(): Object3D[] {
  const sun = new DirectionalLight(new Color("#fff0d8"), 2.3);
  sun.position.copy(SUN_DIRECTION);
  return [sun, new HemisphereLight(new Color("#dff0ff"), new Color("#a9926c"), 1.9)];
}

/** Whether pictures are computed without a graphics card: smooth edges then cost more than they are worth. */
function drawsInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const renderer = gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  return /swiftshader|llvmpipe|software|basic render/i.test(renderer);
}
