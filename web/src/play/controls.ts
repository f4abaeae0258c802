// The therapist's three buttons at the rim: language, sound, full screen. The patient needs none of them.
import { LANGUAGES, language, onLanguage, setLanguage, t } from "../strings";
import { child } from "./dom";
import type { Sound } from "./sound";

const LOUDSPEAKER = '<path d="M4 9v6h4l6 5V4L8 9Z" fill="currentColor"/>';
const WAVES = '<path d="M17 8q3 4 0 8M19.5 5.5q5 6.5 0 13"/>';
const CROSSED = '<path d="m17 9 6 6m0-6-6 6"/>';
const CORNERS = '<path d="M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5"/>';

/** Puts the buttons into `root`; `page` is what fills the screen. */
export function addControls(root: HTMLElement, page: HTMLElement, sound: Sound): void {
  const speech = button(root, "language", () => setLanguage(otherLanguage().id));
  const sounds = button(root, "sound", () => {
    sound.mute(!sound.muted);
    name();
  });
  const fullScreen = button(root, "fullscreen", () => void page.requestFullscreen?.());
  const name = () => {
    speech.textContent = otherLanguage().name;
    speech.lang = otherLanguage().id;
    sign(sounds, LOUDSPEAKER + (sound.muted ? CROSSED : WAVES), t(sound.muted ? "play.sound.off" : "play.sound.on"));
    sounds.setAttribute("aria-pressed", String(!sound.muted));
    sign(fullScreen, CORNERS, t("play.fullscreen"));
    document.title = t("play.title");
  };
  document.addEventListener("fullscreenchange", () => {
    fullScreen.hidden = document.fullscreenElement !== null;
  });
  onLanguage(name);
  // The first touch anywhere lets the sound be heard, unless another screen sounds.
  document.addEventListener("click", name);
  sound.onChange = name;
  name();
}

function otherLanguage(): (typeof LANGUAGES)[number] {
  return LANGUAGES.find((one) => one.id !== language()) ?? { id: "en", name: "English" };
}

function button(root: HTMLElement, testId: string, act: () => void): HTMLButtonElement {
  const element = child(root, "button", "control");
  element.type = "button";
  element.dataset.testid = testId;
  element.addEventListener("click", act);
  return element;
}

/** Gives a button a drawn sign and a name to be read aloud and shown under the pointer. */
function sign(element: HTMLButtonElement, drawing: string, name: string): void {
  element.innerHTML = `<svg viewBox="0 0 24 24" aria-hidden="true">${drawing}</svg>`;
  element.setAttribute("aria-label", name);
  element.title = name;
}
