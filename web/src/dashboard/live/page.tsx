// The live session on one screen: state and controls, 3-D view, curves, sensors, exoskeleton, game.
import { useState } from "preact/hooks";
import { currentSession } from "../../api/client";
import type { Session } from "../../api/types";
import { t } from "../../strings";
import { useAsked } from "../hooks";
import { ProblemBox } from "../problem";
import { hrefOf } from "../route";
import { useStopKey } from "../stop/key";
import { Aside } from "./aside";
import { Authority } from "./authority";
import { Controls } from "./controls";
import { LiveCurve } from "./curve";
import { EndQuestion } from "./end-question";
import { Exo } from "./exo/panel";
import { type Feed, useFromFeed } from "./feed";
import { GamePanel } from "./game/panel";
import "./live.css";
import { Lost } from "./lost";
import { StateBanner } from "./state-banner";
import { useCharge } from "./use-charge";
import { useView3d, View3d, View3dSwitch } from "./view3d";
import { useWho, Who } from "./who";
import { useWishes } from "./wishes";
import "./live-small.css";

interface Props {
  feed: Feed;
  account: string;
}

export function LivePage({ feed, account }: Props) {
  const current = useAsked(currentSession, "current");
  if (current.value) return <Live session={current.value} feed={feed} account={account} />;
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

function Live({ session, feed, account }: Props & { session: Session }) {
  const charge = useCharge(feed, account);
  const wishes = useWishes(session.id);
  const [ending, setEnding] = useState(false);
  const view3d = useView3d();
  const who = useWho(feed);
  const isLost = useFromFeed(feed, 5, ({ link }) => link === "lost");
  const alsoListenIn = useStopKey(wishes.stop.press);
  return (
    <main class={isLost ? "live live-lost" : "live"} data-testid="live">
      <h1 class="spoken">{t("live.title", { name: session.patient_name })}</h1>
      <StateBanner feed={feed}>
        <Controls feed={feed} charge={charge} wishes={wishes} />
        <Authority feed={feed} charge={charge} session={session.id} account={account} />
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
        <Exo feed={feed} session={session.id} charge={charge} />
        <GamePanel feed={feed} session={session.id} charge={charge} />
        <Aside feed={feed} session={session} who={who} onEnd={() => setEnding(true)} />
      </div>
      {isLost && <Lost charge={charge} />}
      {wishes.problem && (
        <div class="toast">
          <ProblemBox problem={wishes.problem} onClose={wishes.forget} />
        </div>
      )}
    </main>
  );
}
