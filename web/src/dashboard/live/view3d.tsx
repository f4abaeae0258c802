// The 3-D view of sensors, body and exoskeleton; may be put away, because drawing it without a graphics card takes the
// better part of a small computer.
import { useRef, useState } from "preact/hooks";
import { readView3d, showInView3d } from "../../api/client";
import type { View3dLook, View3dShown } from "../../api/types";
import { t } from "../../strings";
import { useAsked } from "../hooks";
import { type Feed, useFromFeed } from "./feed";
import "./view3d.css";

const VIEW_PAGE = "/view3d/";
const REMEMBERED_AS = "mirrorlimb.view3d";
const AWAY = "away";

interface Props {
  feed: Feed;
  onLoad: (inside: Window | null) => void;
}

export function View3d({ feed, onLoad }: Props) {
  const frame = useRef<HTMLIFrameElement>(null);
  return (
    <div class="view3d">
      <iframe
        title={t("live.view3d")}
        src={VIEW_PAGE}
        ref={frame}
        onLoad={() => onLoad(frame.current?.contentWindow ?? null)}
        data-testid="view3d"
      />
      <Look feed={feed} />
    </div>
  );
}

/** Legend and switches; without them the view is still a view, and a lost service is said by the page's banner. */
function Look({ feed }: { feed: Feed }) {
  const look = useAsked(readView3d, "look").value;
  const [chosen, setChosen] = useState<View3dShown | null>(null);
  if (!look) return null;
  const shown = chosen ?? look.shown;
  const change = (wanted: View3dShown) => {
    setChosen(wanted);
    showInView3d(wanted).catch(() => undefined);
  };
  return (
    <>
      <Legend feed={feed} shown={shown} colours={look.colours} />
      <Layers shown={shown} onChange={change} />
    </>
  );
}

interface LegendProps {
  feed: Feed;
  shown: View3dShown;
  colours: View3dLook["colours"];
}

/** What each colour is. */
function Legend({ feed, shown, colours }: LegendProps) {
  const names = useFromFeed(feed, 2, ({ newest }) => newest?.tick.sensors.map(({ sensor }) => sensor).join("\n") ?? "");
  const sensors = shown.sensors && names ? names.split("\n") : [];
  const colourOf = (number: number) => colours.sensors[number % colours.sensors.length] ?? "";
  return (
    <ul class="view3d-legend" data-testid="view3d-legend">
      <Entry colour={colours.fused} words={t("live.view3d.fused")} />
      <Entry colour={colours.mirrored} words={t("live.view3d.mirrored")} />
      <Entry colour={colours.exoskeleton} words={t("live.view3d.exoskeleton")} />
      {shown.bounds && <Entry colour={colours.bounds} words={t("live.view3d.bound")} />}
      {sensors.map((sensor, number) => (
        <Entry key={sensor} colour={colourOf(number)} words={sensor} />
      ))}
    </ul>
  );
}

function Entry({ colour, words }: { colour: string; words: string }) {
  return (
    <li>
      <span class="view3d-colour" style={{ background: colour }} />
      {words}
    </li>
  );
}

interface LayersProps {
  shown: View3dShown;
  onChange: (shown: View3dShown) => void;
}

/** What is drawn besides the body and the exoskeleton; the same for everybody who looks. */
function Layers({ shown, onChange }: LayersProps) {
  const layer = (name: keyof View3dShown) => (
    <button
      type="button"
      aria-pressed={shown[name]}
      onClick={() => onChange({ ...shown, [name]: !shown[name] })}
      data-testid={`view3d-${name}`}
    >
      {shown[name] ? "✓ " : ""}
      {t(`live.view3d.${name}`)}
    </button>
  );
  return (
    <div class="view3d-layers">
      {layer("sensors")}
      {layer("bounds")}
    </div>
  );
}

interface Shown {
  isShown: boolean;
  change: () => void;
}

/** Whether the view is shown; this browser remembers it. */
export function useView3d(): Shown {
  const [isShown, setShown] = useState(() => localStorage.getItem(REMEMBERED_AS) !== AWAY);
  const change = () => {
    localStorage.setItem(REMEMBERED_AS, isShown ? AWAY : "shown");
    setShown(!isShown);
  };
  return { isShown, change };
}

export function View3dSwitch({ isShown, change }: Shown) {
  return (
    <button type="button" class="view3d-switch" onClick={change} data-testid="view3d-switch">
      {t(isShown ? "live.view3d.hide" : "live.view3d.show")}
    </button>
  );
}
