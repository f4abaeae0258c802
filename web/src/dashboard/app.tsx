// The dashboard as a whole: who is logged in decides what is shown, then the address does.
import { useEffect } from "preact/hooks";
import { logOut, readStatus } from "../api/client";
import { t } from "../strings";
import { FirstStart, LogIn } from "./entry";
import { Frame } from "./frame";
import { ASK_WHO, useAsked, useDoing, useLanguage, useRoute } from "./hooks";
import { Later } from "./later";
import { type Feed, useFeed } from "./live/feed";
import { LivePage } from "./live/page";
import { ChangePatient, EnrolPatient } from "./patient/form";
import { PatientPage } from "./patient/page";
import { ProblemBox } from "./problem";
import type { Route } from "./route";
import { SummaryPage } from "./session/summary";
import { StopBar } from "./stop/bar";
import { TodayPage } from "./today/page";
import { WizardPage } from "./wizard/page";

/** Pages that show the stop where it belongs on them. */
const BRING_THEIR_STOP: readonly Route["page"][] = ["live", "prepare"];

export function App() {
  useLanguage();
  const route = useRoute();
  const status = useAsked(readStatus, "status");
  const leaving = useDoing();
  useEffect(() => {
    window.addEventListener(ASK_WHO, status.again);
    return () => window.removeEventListener(ASK_WHO, status.again);
  }, [status.again]);

  const account = status.value?.account ?? null;
  const feed = useFeed(account?.name ?? null);
  const leave = () => leaving.run(() => logOut().then(status.again));
  return (
    <Frame account={account} at={account && placeOf(route)} version={status.value?.version ?? ""} onLogOut={leave}>
      <Inside status={status} route={route} feed={feed} problem={<ProblemBox problem={leaving.problem} />} />
      {account && !BRING_THEIR_STOP.includes(route.page) && <StopBar feed={feed} />}
    </Frame>
  );
}

interface InsideProps {
  status: ReturnType<typeof useAsked<Awaited<ReturnType<typeof readStatus>>>>;
  route: Route;
  feed: Feed;
  problem: preact.ComponentChildren;
}

function Inside({ status, route, feed, problem }: InsideProps) {
  const known = status.value;
  if (!known) return <Waiting status={status} />;
  if (known.first_start && !known.account) return <FirstStart demo={known.demo} onEntered={status.again} />;
  if (!known.account) return <LogIn demo={known.demo} onEntered={status.again} />;
  return (
    <>
      {problem}
      <Page route={route} feed={feed} account={known.account.name} />
    </>
  );
}

function Waiting({ status }: { status: InsideProps["status"] }) {
  return (
    <main class="page page-narrow">
      {status.problem ? <ProblemBox problem={status.problem} onRetry={status.again} /> : <p>{t("app.loading")}</p>}
    </main>
  );
}

/** Pages that are fetched when somebody goes there. */
const LATER = {
  plan: () => import("./plan/page").then(({ PlanPage }) => PlanPage),
  progress: () => import("./progress/page").then(({ ProgressPage }) => ProgressPage),
  scores: () => import("./scores/page").then(({ ScoresPage }) => ScoresPage),
  "course-report": () => import("./report/course").then(({ CourseReport }) => CourseReport),
  replay: () => import("./replay/page").then(({ ReplayPage }) => ReplayPage),
  "session-report": () => import("./report/session").then(({ SessionReport }) => SessionReport),
};

interface PageProps {
  route: Route;
  feed: Feed;
  account: string;
}

function Page({ route, feed, account }: PageProps) {
  switch (route.page) {
    case "patients":
      return <TodayPage />;
    case "enrol":
      return <EnrolPatient />;
    case "patient":
      return <PatientPage key={route.id} id={route.id} />;
    case "change-patient":
      return <ChangePatient key={route.id} id={route.id} />;
    case "prepare":
      return <WizardPage key={route.id} id={route.id} feed={feed} account={account} />;
    case "plan":
    case "progress":
    case "scores":
    case "course-report":
    case "replay":
    case "session-report":
      return <Later key={`${route.page} ${route.id}`} load={LATER[route.page]} id={route.id} />;
    case "live":
      return <LivePage feed={feed} account={account} />;
    case "summary":
      return <SummaryPage key={route.id} id={route.id} />;
  }
}

function placeOf(route: Route): "patients" | "live" {
  return route.page === "live" ? "live" : "patients";
}
