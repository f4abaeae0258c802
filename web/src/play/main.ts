// The patient's screen: takes the stream, draws sixty times a second what it says, and decides nothing.
import "./play.css";
import "./pain.css";
import { connectLive } from "../api/live";
import type { LiveMessage } from "../api/types";
import { t } from "../strings";
import { accessOf } from "./access";
import { keepAwake } from "./awake";
import { addControls } from "./controls";
import { child } from "./dom";
import { Pain } from "./pain";
import { Picture } from "./picture";
import type { Access } from "./screen";
import { Sound } from "./sound";

function part<E extends HTMLElement>(id: string): E {
  const element = document.getElementById(id);
  if (!element) throw new Error(`play.html has no element "${id}"`);
  return element as E;
}

function start(): void {
  const page = part("play");
  const sound = new Sound();
  addControls(part("controls"), page, sound);
  const pain = new Pain(part("pain"));
  const picture = open(page, sound);
  let access: Access = "connecting";
  connectLive(
    "patient",
    (message: LiveMessage) => {
      pain.take(message);
      picture?.take(message, seconds());
    },
    (link) => {
      access = link;
      void accessOf(link).then((known) => {
        if (access === link) access = known;
      });
    },
  );
  const draw = () => {
    requestAnimationFrame(draw);
    picture?.draw(access, seconds());
  };
  if (picture) draw();
  keepAwake();
}

/** The picture, or null with a plain sentence on the page where the browser has no WebGL. */
function open(page: HTMLElement, sound: Sound): Picture | null {
  const overlay = part("overlay");
  if (document.createElement("canvas").getContext("webgl2")) {
    return new Picture(
      page,
      part<HTMLCanvasElement>("picture"),
      part<HTMLCanvasElement>("backdrop"),
      part("hud"),
      overlay,
      sound,
    );
  }
  const panel = child(overlay, "div", "panel");
  panel.setAttribute("role", "alert");
  child(panel, "h1", "title").append(t("play.unable.title"));
  child(panel, "p", "text").append(t("play.unable.text"));
  return null;
}

function seconds(): number {
  return performance.now() / 1000;
}

start();
