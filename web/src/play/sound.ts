// Gentle sounds made on the spot, heard from where they happen: left, right or between. Silent until somebody has
// touched the page (browsers ask for that) and while muted.

const REMEMBERED_AS = "mirrorlimb.play.muted";
const LOUDNESS = 0.16;

/** A sound this far to the side is heard from that side alone; in metres of the trunk frame. */
const FULL_SIDE_M = 0.6;

/** A tone: when it begins after now, its pitch, how long it rings. */
export interface Tone {
  readonly after_s: number;
  readonly pitch_hz: number;
  readonly ring_s: number;
}

export type Cue = "hit" | "streak" | "rest" | "playing" | "over";

// A pentatonic scale: whatever follows whatever, it never sounds wrong.
const G4 = 392;
const C5 = 523.25;
const D5 = 587.33;
const E5 = 659.25;
const G5 = 783.99;
const A5 = 880;
const C6 = 1046.5;

export const tone = (after_s: number, pitch_hz: number, ring_s: number): Tone => ({ after_s, pitch_hz, ring_s });
const CUES: Record<Cue, readonly Tone[]> = {
  hit: [tone(0, E5, 0.9), tone(0.09, A5, 1.2)],
  streak: [tone(0, C5, 0.8), tone(0.09, E5, 0.8), tone(0.18, G5, 0.9), tone(0.27, C6, 1.6)],
  rest: [tone(0, G5, 1.6), tone(0.3, D5, 1.8), tone(0.6, G4, 2.4)],
  playing: [tone(0, G4, 0.9), tone(0.18, C5, 1.4)],
  over: [tone(0, C5, 1.2), tone(0.2, E5, 1.2), tone(0.4, G5, 1.4), tone(0.6, C6, 2.6)],
};

export class Sound {
  private context: AudioContext | null = null;
  private silenced = localStorage.getItem(REMEMBERED_AS) === "yes";
  private elsewhere = false;
  /** Called when `muted` may have changed. */
  onChange: () => void = () => {};

  constructor() {
    const wake = () => this.wake();
    document.addEventListener("click", wake);
    document.addEventListener("keydown", wake);
  }

  /** True while nothing can be heard: switched off, another screen's turn, or nobody has touched the page yet. */
  get muted(): boolean {
    return this.silenced || this.elsewhere || this.context === null;
  }

  /** Another screen makes the sounds, or no longer; a person's click on the button overrules it. */
  cede(elsewhere: boolean): void {
    if (elsewhere === this.elsewhere) return;
    this.elsewhere = elsewhere;
    this.onChange();
  }

  /** To be called from a person's click. */
  mute(silenced: boolean): void {
    this.silenced = silenced;
    this.elsewhere = false;
    localStorage.setItem(REMEMBERED_AS, silenced ? "yes" : "no");
    this.wake();
    this.play("hit");
  }

  /** Plays a shared cue from `x_m` to the right of the patient's middle. */
  play(cue: Cue, x_m = 0): void {
    this.ring(CUES[cue], x_m);
  }

  ring(tones: readonly Tone[], x_m = 0): void {
    const { context } = this;
    if (!context || this.muted) return;
    const place = new StereoPannerNode(context, { pan: panOf(x_m) });
    place.connect(context.destination);
    for (const one of tones) strike(context, one, place);
  }

  private wake(): void {
    if (this.context) void this.context.resume();
    else this.context = new AudioContext();
  }
}

/** Where between left (−1) and right (1) something is heard. */
export function panOf(x_m: number): number {
  return Math.max(-1, Math.min(1, x_m / FULL_SIDE_M));
}

/** A soft bell: the tone and a faint octave above it, both dying away. */
function strike(context: AudioContext, { after_s, pitch_hz, ring_s }: Tone, place: AudioNode): void {
  for (const [multiple, share] of [
    [1, 1],
    [2, 0.25],
  ] as const) {
    const start_s = context.currentTime + after_s;
    const oscillator = context.createOscillator();
    const volume = context.createGain();
    oscillator.frequency.value = pitch_hz * multiple;
    volume.gain.setValueAtTime(0, start_s);
    volume.gain.linearRampToValueAtTime(LOUDNESS * share, start_s + 0.012);
    volume.gain.exponentialRampToValueAtTime(0.0005, start_s + ring_s / multiple);
    oscillator.connect(volume).connect(place);
    oscillator.start(start_s);
    oscillator.stop(start_s + ring_s);
  }
}
