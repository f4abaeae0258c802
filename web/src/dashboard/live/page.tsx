// The live session on one screen: state and controls, 3-D view, curves, sensors, exoskeleton, game.
import { useState } from "preact/hooks";
import { currentSession } from "../../api/client";
import type { Action, Session } from "../../api/types";
import { t } from "../../strings";
import { useAsked, useDoing } from "../hooks";
import { ProblemBox } from "../problem";
import { hrefOf } from "../route";
import { send } from "./actions";
import { Aside } from "./aside";
import { Controls } from "./controls";
import { LiveCurve } from "./curve";
import { EndQuestion } from "./end-question";
import { Exo } from "./exo";
import { useFeed } from "./feed";
import "./live.css";
import "./live-small.css";
import { Sensors } from "./sensors";
import { StateBanner } from "./state-banner";
import { useStopKey } from "./stop-key";
import { useView3d, View3d, View3dSwitch } from "./view3d";
import { useWho, Who } from "./who";

export function LivePage() {
  const current = useAsked(currentSession, "current");
  if (current.value) return <Live session={current.value} />;
  return (
    <main class="page page-narrow">
      <ProblemBox problem={current.problem} onRetry={current.again} />
      {!current.problem && current.answered && <NoSession />}
    </main>
  );
}

function NoSession() {
  return (
    <section class="card">
      <h1>{t("live.none")}</h1>
      <p>{t("live.none.what")}</p>
      <a class="button primary big" href={hrefOf({ page: "patients" })}>
        {t("nav.patients")}
      </a>
    </section>
  );
}

function Live({ session }: { session: Session }) {
  const feed = useFeed();
  const wishes = useDoing();
  const [ending, setEnding] = useState(false);
  const view3d = useView3d();
  const who = useWho(feed);
  const [pressed, setPressed] = useState<Action | null>(null);
  const wish = (action: Action) => {
    setPressed(action);
    wishes.run(() => send(session.id, action));
  };
  const alsoListenIn = useStopKey(() => wish("stop"));
  return (
    <main class="live" data-testid="live">
      <StateBanner feed={feed}>
        <Controls feed={feed} pending={wishes.busy ? pressed : null} onWish={wish} />
      </StateBanner>
      <div class={view3d.isShown ? "live-main" : "live-main live-main-flat"}>
        {view3d.isShown && <View3d feed={feed} onLoad={alsoListenIn} />}
        <div class="live-curves">
          <LiveCurve feed={feed} first="elevation" />
          <LiveCurve feed={feed} first="elbow" />
        </div>
        <View3dSwitch {...view3d} />
        {who.isShown && <Who feed={feed} session={session.id} onClose={who.close} />}
        {ending && <EndQuestion session={session.id} onCancel={() => setEnding(false)} />}
      </div>
      <div class="live-foot">
        <Sensors feed={feed} />
        <Exo feed={feed} />
        <Aside feed={feed} session={session} who={who} onEnd={() => setEnding(true)} />
      </div>
      {wishes.problem && (
        <div class="toast">
          <ProblemBox problem={wishes.problem} onClose={wishes.forget} />
        </div>
      )}
    </main>
  );
}
