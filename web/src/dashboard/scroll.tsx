// A wide table in a place of its own that scrolls, also by the arrow keys.
import type { ComponentChildren } from "preact";

interface Props {
  label: string;
  /** A further class. */
  look?: string;
  children: ComponentChildren;
}

export function Scroll({ label, look = "", children }: Props) {
  return (
    // biome-ignore lint/a11y/noNoninteractiveTabindex: what scrolls must be reached by the keyboard (WCAG 2.1.1)
    <section class={`table-scroll ${look}`} aria-label={label} tabIndex={0}>
      {children}
    </section>
  );
}
