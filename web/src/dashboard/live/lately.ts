// Words that a tick says only once, kept long enough to be read.

const KEPT_S = 2.5;

export class Lately {
  private readonly until = new Map<string, number>();

  take(words: readonly string[], now_s: number): void {
    for (const one of words) this.until.set(one, now_s + KEPT_S);
  }

  /** What was said within the last seconds, in the order in which it was first said. */
  at(now_s: number): string[] {
    for (const [words, end_s] of this.until) if (end_s < now_s) this.until.delete(words);
    return [...this.until.keys()];
  }
}
