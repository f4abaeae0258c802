// The stop: never disabled, acts when a finger or a button goes down, and says what has become of it.
import { t } from "../../strings";
import type { StopPress } from "./press";
import "./stop.css";

interface Props extends Pick<StopPress, "progress" | "press"> {
  /** The station says that the arm is stopped, by whomever: then nobody is still waited for. */
  isStopped: boolean;
}

export function StopButton({ progress: answered, press, isStopped }: Props) {
  const progress = answered === "unanswered" && isStopped ? "done" : answered;
  return (
    <>
      <button
        type="button"
        class="stop"
        data-progress={progress}
        // Going down is enough: a finger that slips off the button must not undo a stop.
        onPointerDown={(event) => event.isPrimary && event.button === 0 && press()}
        // Assistive technology clicks without pressing down before (detail 0).
        onClick={(event) => event.detail === 0 && press()}
        data-testid="stop"
      >
        {t("control.stop")}
        <span class="key-hint">{progress === "idle" ? t("control.stop.keys") : t(`stop.${progress}`)}</span>
      </button>
      <span class="spoken" role="status">
        {progress === "idle" ? "" : t(`stop.${progress}.spoken`)}
      </span>
    </>
  );
}
