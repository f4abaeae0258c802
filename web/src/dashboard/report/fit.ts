// Keeps a sheet on one page of A4: where there is much to say, it is printed smaller.
import { useEffect, useRef } from "preact/hooks";

/** A4 without the margins that `report.css` sets, at 96 dots an inch, and a little less so that rounding never breaks it. */
export const PAGE_HEIGHT_PX = Math.floor(((297 - 2 * 12) / 25.4) * 96) - 6;

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
      if (!matchMedia("print").matches) element.style.setProperty("--fit", String(scaleFor(contentHeight(element))));
    });
    observer.observe(element);
    return () => observer.disconnect();
  }, []);
  return sheet;
}

/** Without the margin that the sheet has on the screen; on paper the page brings its own. */
function contentHeight(sheet: HTMLElement): number {
  const { paddingTop, paddingBottom } = getComputedStyle(sheet);
  return sheet.scrollHeight - Number.parseFloat(paddingTop) - Number.parseFloat(paddingBottom);
}
