// The 3-D view of sensors, body and exoskeleton; may be put away, because drawing it without a graphics card takes the
// better part of a small computer.
import { useEffect, useRef, useState } from "preact/hooks";
import { showInView3d } from "../../api/client";
import type { View3dShown } from "../../api/types";
import { t } from "../../strings";

const VIEW_PAGE = "/view3d/";
const REMEMBERED_AS = "mirrorlimb.view3d";
const AWAY = "away";

export function View3d({ onLoad }: { onLoad: (inside: Window | null) => void }) {
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
      <Layers />
    </div>
  );
}

/** What is drawn besides the body and the exoskeleton; the same for everybody who looks. */
function Layers() {
  const [shown, setShown] = useState<View3dShown>({ sensors: true, bounds: false });
  useEffect(() => {
    // A view without its switches is still a view; a lost service is said by the page's banner.
    showInView3d(shown).catch(() => undefined);
  }, [shown]);
  const layer = (name: keyof View3dShown) => (
    <button
      type="button"
      aria-pressed={shown[name]}
      onClick={() => setShown({ ...shown, [name]: !shown[name] })}
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
