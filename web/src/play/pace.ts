// Frames per second, and when to give up a luxury so that the arm keeps moving smoothly.

/** What the picture can do without, in the order in which it is given up. */
export type Luxury = "fine pixels" | "shadows" | "half the pixels";
const LUXURIES: readonly Luxury[] = ["fine pixels", "shadows", "half the pixels"];

/** Below this rate for `SLOW_WINDOWS` windows in a row, one luxury goes. */
export const SLOW_FPS = 40;
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
  private given = 0;
  private last_s: number | null = null;

  /** Counts a frame drawn at `now_s`; says which luxury to give up now, if any. */
  frame(now_s: number): Luxury | null {
    const step_s = this.last_s === null ? GAP_S : now_s - this.last_s;
    this.last_s = now_s;
    if (step_s >= GAP_S) return this.restart();
    this.frames += 1;
    this.window_s += step_s;
    return this.window_s < WINDOW_S ? null : this.closeWindow();
  }

  private restart(): null {
    this.frames = 0;
    this.window_s = 0;
    return null;
  }

  private closeWindow(): Luxury | null {
    this.fps = this.frames / this.window_s;
    this.restart();
    this.slow = this.fps < SLOW_FPS ? this.slow + 1 : 0;
    if (this.slow < SLOW_WINDOWS) return null;
    this.slow = 0;
    return LUXURIES[this.given++] ?? null;
  }
}
