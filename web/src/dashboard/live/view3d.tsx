// The 3-D view of sensors, body and exoskeleton; may be put away, because drawing it without a graphics card takes the
// better part of a small computer.
import { useRef, useState } from "preact/hooks";
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
