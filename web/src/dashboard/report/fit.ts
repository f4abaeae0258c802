// Keeps a sheet on one page of A4: where there is much to say, it is printed smaller.
import { useEffect, useRef } from "preact/hooks";

/** Around the sheet on every side, as in `report.css`. */
const MARGIN_MM = 12;
const PAGE_WIDTH_MM = 210 - 2 * MARGIN_MM;
/** A4 inside its margins at 96 dots an inch, and a little less, so that rounding never breaks it. */
export const PAGE_HEIGHT_PX = Math.floor(((297 - 2 * MARGIN_MM) / 25.4) * 96) - 6;

/** How much smaller a sheet of that height is printed. */
export function scaleFor(height_px: number): number {
  return height_px <= PAGE_HEIGHT_PX ? 1 : PAGE_HEIGHT_PX / height_px;
}

/** To be given to the sheet; writes `--fit` to it whenever its height changes. */
export function useFit() {
  const sheet = useRef<HTMLElement>(null);
  useEffect(() => {
    const element = sheet.current;
    if (!element) return;
    const observer = new ResizeObserver(() => {
      // In print the sheet is smaller already: measuring it then would make it small twice.
      if (!matchMedia("print").matches) element.style.setProperty("--fit", String(scaleFor(heightOnPaper(element))));
    });
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  return sheet;
}

/** As wide as paper and without the margin that it has on the screen, however wide the screen is. */
function heightOnPaper(sheet: HTMLElement): number {
  const { width, padding } = sheet.style;
  Object.assign(sheet.style, { width: `${PAGE_WIDTH_MM}mm`, padding: "0" });
  const height = sheet.scrollHeight;
  Object.assign(sheet.style, { width, padding });
  return height;
}
