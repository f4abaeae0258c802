// Keeps a tablet or television from going dark while the page is shown.

/** Asks for the screen to stay on, and again whenever the page comes back into view. */
export function keepAwake(): void {
  const ask = () => {
    // Refused on low battery or without https: the picture simply dims as it would have.
    if (document.visibilityState === "visible") navigator.wakeLock?.request("screen").catch(() => undefined);
  };
  document.addEventListener("visibilitychange", ask);
  ask();
}
