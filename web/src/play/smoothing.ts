// Where the arm is at the moment of drawing: between and just beyond the ticks, without waiting for the next one.

/** Nothing is shown further ahead of the newest tick than one frame of a 30 Hz screen. */
export const MAX_AHEAD_S = 1 / 30;
/** Velocity is taken over this span, so that the noise of a single tick does not become motion. */
const VELOCITY_SPAN_S = 0.05;
const SHORTEST_SPAN_S = 0.005;
/** How fast a correction is blended in when a tick turns out otherwise than foreseen. */
const BLEND_S = 0.025;
/** A jump further than this is another pose, not a movement: shown at once. */
const JUMP_M = 0.3;
/** The two clocks may drift apart; the offset follows upwards this slowly (s per s). */
const OFFSET_LEAK = 0.002;

interface Sample {
  readonly t_s: number;
  readonly values: readonly number[];
}

/** The fastest way from the station's clock to this screen's, so that network jitter does not shake the picture. */
export class ClockOffset {
  private offset_s = Number.POSITIVE_INFINITY;
  private last_s = 0;

  /** Learns from a tick of station time `t_s` that arrived at `now_s`. */
  take(t_s: number, now_s: number): void {
    const leak = Math.max(0, now_s - this.last_s) * OFFSET_LEAK;
    this.offset_s = Math.min(this.offset_s + leak, now_s - t_s);
    this.last_s = now_s;
  }

  /** Station time that can be known at `now_s`. */
  stationTime(now_s: number): number {
    return now_s - this.offset_s;
  }
}

/** Follows a list of coordinates (metres) from ticks that come unevenly. */
export class Follower {
  private readonly clock = new ClockOffset();
  private samples: Sample[] = [];
  private error: number[] = [];
  private error_s = 0;

  /** Takes the values of station time `t_s`, arrived at `now_s`. Older or repeated ticks change nothing. */
  take(t_s: number, values: readonly number[], now_s: number): void {
    const newest = this.samples.at(-1);
    if (newest && t_s <= newest.t_s && newest.t_s - t_s < 1) return;
    if (newest && (t_s < newest.t_s || isJump(newest.values, values))) this.forget();
    const shown = this.at(now_s);
    this.clock.take(t_s, now_s);
    this.samples = [...this.samples.filter((s) => s.t_s >= t_s - VELOCITY_SPAN_S), { t_s, values }];
    this.error = shown ? difference(shown, this.foreseen(now_s)) : values.map(() => 0);
    this.error_s = now_s;
  }

  /** The values to draw at `now_s`; null before the first tick. */
  at(now_s: number): number[] | null {
    if (this.samples.length === 0) return null;
    const left = Math.exp(-Math.max(0, now_s - this.error_s) / BLEND_S);
    return this.foreseen(now_s).map((value, i) => value + left * (this.error[i] ?? 0));
  }

  /** Starts afresh, as after another arm was chosen. */
  forget(): void {
    this.samples = [];
    this.error = [];
  }

  private foreseen(now_s: number): number[] {
    const newest = this.samples.at(-1);
    const oldest = this.samples[0];
    if (!newest || !oldest) return [];
    const span_s = newest.t_s - oldest.t_s;
    const ahead_s = clamp(this.clock.stationTime(now_s) - newest.t_s, 0, MAX_AHEAD_S);
    const share = span_s < SHORTEST_SPAN_S ? 0 : ahead_s / span_s;
    return newest.values.map((value, i) => value + share * (value - (oldest.values[i] ?? value)));
  }
}

function clamp(value: number, low: number, high: number): number {
  return Math.min(high, Math.max(low, value));
}

function difference(a: readonly number[], b: readonly number[]): number[] {
  return a.map((value, i) => value - (b[i] ?? value));
}

function isJump(before: readonly number[], after: readonly number[]): boolean {
  return before.length !== after.length || after.some((value, i) => Math.abs(value - (before[i] ?? value)) > JUMP_M);
}
