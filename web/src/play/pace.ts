// Frames per second, and whether the picture must become coarser so that the arm keeps moving smoothly.

/** Slower than this share of the rate hoped for, for `SLOW_WINDOWS` windows in a row: the picture is to become coarser. */
const SLOW_SHARE = 0.7;
const WINDOW_S = 1;
const SLOW_WINDOWS = 2;
/** A pause this long is a hidden window or a sleeping tablet, not a slow screen. */
const GAP_S = 0.5;

export class Pace {
  /** Frames per second over the last full window; 0 until there is one. */
  fps = 0;
  private frames = 0;
  private window_s = 0;
  private slow = 0;
  private last_s: number | null = null;

  constructor(private readonly hoped_fps: number) {}

  /** Counts a frame drawn at `now_s`; true when it has been too slow for too long. */
  frame(now_s: number): boolean {
    const step_s = this.last_s === null ? GAP_S : now_s - this.last_s;
    this.last_s = now_s;
    if (step_s >= GAP_S) return this.restart();
    this.frames += 1;
    this.window_s += step_s;
    return this.window_s >= WINDOW_S && this.closeWindow();
  }

  private restart(): false {
    this.frames = 0;
    this.window_s = 0;
    return false;
  }

  private closeWindow(): boolean {
    this.fps = this.frames / this.window_s;
    this.restart();
    this.slow = this.fps < SLOW_SHARE * this.hoped_fps ? this.slow + 1 : 0;
    if (this.slow < SLOW_WINDOWS) return false;
    this.slow = 0;
    return true;
  }
}
