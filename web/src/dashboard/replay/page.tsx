// A past session in a 3-D view with a time line: play, pause, speed, scrub, and from event to event.
import { readSession, readView3d } from "../../api/client";
import { t } from "../../strings";
import { dateAndTime } from "../format";
import { useAsked } from "../hooks";
import { ProblemBox } from "../problem";
import { hrefOf } from "../route";
import { ReplayControls } from "./controls";
import { usePlayer } from "./player";
import "./replay.css";

const VIEW_PAGE = "/replay3d/";

export function ReplayPage({ id }: { id: number }) {
  const session = useAsked(() => readSession(id), id);
  const player = usePlayer(id);
  const { heard, timeline, isGone, doing, drive } = player;
  return (
    <main class="page replay" data-testid="replay">
      <div class="heading">
        <div>
          <h1>{session.value && t("replay.title", { name: session.value.patient_name })}</h1>
          <p class="soft">{dateAndTime(session.value?.started_at)}</p>
        </div>
        <a class="button" href={hrefOf({ page: "summary", id })}>
          {t("replay.summary")}
        </a>
      </div>
      <ProblemBox problem={session.problem ?? doing.problem} onRetry={() => drive({ t_s: 0 })} />
      {doing.busy && !heard && (
        <p class="card" role="status">
          {t("replay.reading")}
        </p>
      )}
      {isGone && <Gone onAgain={() => drive({})} />}
      {heard && !isGone && (
        <>
          <div class="replay-view">
            <iframe title={t("replay.view")} src={VIEW_PAGE} data-testid="replay-view" />
            <Legend />
          </div>
          <ReplayControls heard={heard} timeline={timeline} onDrive={drive} />
        </>
      )}
    </main>
  );
}

function Gone({ onAgain }: { onAgain: () => void }) {
  return (
    <div class="notice" role="status" data-testid="replay-gone">
      <p>{t("replay.gone")}</p>
      <button type="button" onClick={onAgain}>
        {t("replay.again")}
      </button>
    </div>
  );
}

/** What each colour is, the same as in the live view. */
function Legend() {
  const colours = useAsked(readView3d, "look").value?.colours;
  if (!colours) return null;
  return (
    <ul class="replay-legend">
      {(["fused", "mirrored", "exoskeleton"] as const).map((thing) => (
        <li key={thing}>
          <span style={{ background: colours[thing] }} />
          {t(`live.view3d.${thing}`)}
        </li>
      ))}
    </ul>
  );
}
