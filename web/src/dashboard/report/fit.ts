// Keeps a sheet on one page of A4: where there is much to say, it is printed smaller.
import { useEffect, useRef } from "preact/hooks";

/** Around the sheet on every side, as in `report.css`. */
const MARGIN_MM = 12;
const PAGE_WIDTH_MM = 210 - 2 * MARGIN_MM;
/** A4 inside its margins at 96 dots an inch, and a little less, so that rounding never breaks it. */
export const PAGE_HEIGHT_PX = Math.floor(((297 - 2 * MARGIN_MM) / 25.4) * 96) - 6;

const SMALLEST = 0.4;
const STEPS = 6;

/** The largest scale up to 1 at which a sheet fits; `heightAt` says how high it is, unscaled, when its lines are 1/scale as long. */
export function largestScale(heightAt: (scale: number) => number): number {
  const fits = (scale: number) => heightAt(scale) * scale <= PAGE_HEIGHT_PX;
  if (fits(1)) return 1;
  let [low, high] = [SMALLEST, 1];
  for (let step = 0; step < STEPS; step++) {
    const middle = (low + high) / 2;
    if (fits(middle)) low = middle;
    else high = middle;
  }
  return low;
}

/** To be given to the sheet; writes `--fit` to it whenever its height changes. */
export function useFit() {
  const sheet = useRef<HTMLElement>(null);
  useEffect(() => {
    const element = sheet.current;
    if (!element) return;
    const observer = new ResizeObserver(() => {
      // In print the sheet is smaller already: measuring it then would make it small twice.
      if (matchMedia("print").matches) return;
      element.style.setProperty("--fit", String(largestScale((scale) => heightOnPaper(element, scale))));
    });
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  return sheet;
}

/** As wide as paper allows at that scale and without the margin that it has on the screen, however wide the screen is. */
function heightOnPaper(sheet: HTMLElement, scale: number): number {
  const { width, padding } = sheet.style;
  Object.assign(sheet.style, { width: `${PAGE_WIDTH_MM / scale}mm`, padding: "0" });
  const height = sheet.scrollHeight;
  Object.assign(sheet.style, { width, padding });
  return height;
}
