// The therapist's three buttons at the rim: full screen, sound, language. The patient needs none of them.
import { LANGUAGES, language, onLanguage, setLanguage, t } from "../strings";
import { child } from "./dom";
import type { Sound } from "./sound";

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
    sounds.textContent = t(sound.muted ? "play.sound.off" : "play.sound.on");
    sounds.setAttribute("aria-pressed", String(!sound.muted));
    fullScreen.textContent = t("play.fullscreen");
    document.title = t("play.title");
  };
  document.addEventListener("fullscreenchange", () => {
    fullScreen.hidden = document.fullscreenElement !== null;
  });
  onLanguage(name);
  // The first touch anywhere lets the sound be heard.
  document.addEventListener("click", name);
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
