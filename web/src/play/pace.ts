// How many frames a second and how many pixels a machine can give: as much as it has, and less where it is busy.

/** How much is asked of the machine: frames a second at most, and pixels drawn per pixel of the page, each way. */
export interface Effort {
  readonly fps: number;
  readonly pixels: number;
}

/** Slower than this share of the rate asked for is slow. */
const SLOW_SHARE = 0.8;
const WINDOW_S = 1;
/** A busy machine makes a single tick late now and then. */
const LATE_TICKS = 4;
/** So many slow windows in a row: less is asked for. */
const SLOW_WINDOWS = 2;
/** So many good windows in a row: more is tried; twice as many after each time that it was too much. */
const GOOD_WINDOWS = 10;
const MOST_GOOD_WINDOWS = 160;
/** A pause this long is a hidden window or a sleeping tablet, not a slow screen. */
const GAP_S = 0.5;

/**
 * What is asked for, from most to least: pixels go first, since a coarse arm that moves smoothly is still one's own, and
 * only then frames.
 */
export function effortsOf(finest: number, software: boolean): readonly Effort[] {
  const full = [1, 0.75, 0.5].map((share) => ({ fps: 60, pixels: Math.max(0.5, finest * share) }));
  const sparing = [0.75, 0.5].map((share) => ({ fps: 30, pixels: Math.max(0.5, finest * share) }));
  return software ? [...full, ...sparing] : [...full, ...sparing.slice(1)];
}

export class Pace {
  /** Frames per second over the last full window; 0 until there is one. */
  fps = 0;
  private frames = 0;
  private window_s = 0;
  private slow = 0;
  private good = 0;
  private patience = GOOD_WINDOWS;
  private late = 0;
  private last_s: number | null = null;

  /** Begins with the effort of that index. */
  constructor(
    private readonly efforts: readonly Effort[],
    private index: number,
  ) {}

  get effort(): Effort {
    return this.efforts[this.index] ?? { fps: 30, pixels: 0.5 };
  }

  /** Whether a frame is due at `now_s`; a quarter early, since screens do not keep time exactly. */
  isDue(now_s: number): boolean {
    return this.last_s === null || now_s - this.last_s >= 0.75 / this.effort.fps;
  }

  /** Something else on this machine came too late, so many times more; several in a window, and it counts as slow. */
  strain(late: number): void {
    this.late += late;
  }

  /** Counts a frame drawn at `now_s`; true when another effort is to be made from now on. */
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
    this.late = 0;
    return false;
  }

  private closeWindow(): boolean {
    this.fps = this.frames / this.window_s;
    const isSlow = this.late >= LATE_TICKS || this.fps < SLOW_SHARE * this.effort.fps;
    this.restart();
    this.slow = isSlow ? this.slow + 1 : 0;
    this.good = isSlow ? 0 : this.good + 1;
    if (this.slow >= SLOW_WINDOWS) return this.give(1);
    return this.good >= this.patience && this.give(-1);
  }

  /** One effort less (1) or more (−1), where there is one. */
  private give(less: 1 | -1): boolean {
    this.slow = 0;
    this.good = 0;
    const next = this.index + less;
    if (next < 0 || next >= this.efforts.length) return false;
    if (less === 1) this.patience = Math.min(2 * this.patience, MOST_GOOD_WINDOWS);
    this.index = next;
    return true;
  }
}
