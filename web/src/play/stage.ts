// The frame around the scene: renderer, the patient's eyes, screen sizes, and what is given up on slow screens.
import {
  Color,
  DirectionalLight,
  HemisphereLight,
  PCFShadowMap,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Luxury } from "./pace";

/** A little above and behind the real eyes, so that the whole forearm and what it reaches for are in view (trunk frame). */
const EYES_IN_TRUNK = new Vector3(0, 0.36, 0.34);
const GAZE_IN_TRUNK = new Vector3(0, -0.17, -0.5);
/** Eyes move towards the acting arm's side by this share of its shoulder's distance. */
const EYES_SHIFT_M = 0.07;
const HEIGHT_RAD = (56 * Math.PI) / 180;
/** On narrow screens the picture keeps at least this width. */
const LEAST_WIDTH_RAD = (66 * Math.PI) / 180;
const SHADOW_MAP = 1024;
const FINE_PIXELS = 1.5;

export class Stage {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(56, 1, 0.05, 120);
  private readonly renderer: WebGLRenderer;
  private readonly sun = new DirectionalLight(new Color("#fff0d8"), 2.3);
  private pixelRatio = Math.min(devicePixelRatio, FINE_PIXELS);

  /** Throws where the browser has no WebGL. */
  constructor(private readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: "high-performance" });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.light();
    this.look("right");
    addEventListener("resize", () => this.fit());
    this.fit();
  }

  /** Puts the eyes where an arm of that side is well seen. */
  look(side: "left" | "right"): void {
    const shift = side === "left" ? EYES_SHIFT_M : -EYES_SHIFT_M;
    this.camera.position.copy(EYES_IN_TRUNK).setX(shift);
    this.camera.lookAt(GAZE_IN_TRUNK);
    this.camera.updateMatrixWorld();
  }

  render(): void {
    this.renderer.render(this.scene, this.camera);
  }

  /** Gives up one luxury for the sake of smooth movement. */
  giveUp(luxury: Luxury): void {
    if (luxury === "shadows") this.dropShadows();
    else this.pixelRatio = luxury === "fine pixels" ? Math.min(1, this.pixelRatio) : this.pixelRatio * 0.7;
    this.fit();
  }

  /** Where a point of the trunk frame appears, in pixels of the page. */
  onPage(point: Vector3): { x: number; y: number } {
    const seen = point.clone().project(this.camera);
    return { x: ((seen.x + 1) / 2) * this.canvas.clientWidth, y: ((1 - seen.y) / 2) * this.canvas.clientHeight };
  }

  private fit(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(this.pixelRatio);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    const wideEnough_rad = 2 * Math.atan(Math.tan(LEAST_WIDTH_RAD / 2) / this.camera.aspect);
    this.camera.fov = (Math.max(HEIGHT_RAD, wideEnough_rad) * 180) / Math.PI;
    this.camera.updateProjectionMatrix();
  }

  /** Soft light from everywhere, and one sun nearly overhead: shadows fall beneath things and so tell their depth. */
  private light(): void {
    const { sun } = this;
    sun.position.set(0.35, 2.2, 0.1);
    sun.target.position.set(0, 0, -0.25);
    sun.castShadow = true;
    sun.shadow.mapSize.set(SHADOW_MAP, SHADOW_MAP);
    sun.shadow.bias = -0.002;
    sun.shadow.normalBias = 0.01;
    sun.shadow.radius = 3;
    Object.assign(sun.shadow.camera, { left: -1, right: 1, top: 0.9, bottom: -0.9, near: 0.5, far: 4 });
    this.scene.add(sun, sun.target, new HemisphereLight(new Color("#dff0ff"), new Color("#a9926c"), 1.9));
  }

  private dropShadows(): void {
    this.sun.castShadow = false;
    this.renderer.shadowMap.enabled = false;
  }
}
