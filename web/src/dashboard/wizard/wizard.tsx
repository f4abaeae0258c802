// The wizard itself: which step is shown, and what has been answered.
import { useEffect, useState } from "preact/hooks";
import { followBody, openSession } from "../../api/client";
import type { Patient, Plan, Session } from "../../api/types";
import { t } from "../../strings";
import { type Doing, useDoing } from "../hooks";
import { type Feed, useFromFeed } from "../live/feed";
import { ProblemBox } from "../problem";
import { go, hrefOf } from "../route";
import { type Answers, firstAnswers, formOf } from "./answers";
import { type Choice, choiceOf } from "./choice";
import { useFacts } from "./facts";
import { Foot } from "./foot";
import { OpenHead } from "./open-head";
import { Picture } from "./picture";
import { Rail } from "./rail";
import { StepView } from "./step-view";
import { firstToDo, type Step } from "./steps";
import { useWorkspace } from "./use-workspace";

interface Props {
  patient: Patient;
  plan: Plan | null;
  /** The open session, whosever it is. */
  session: Session | null;
  feed: Feed;
  account: string;
  onSigned: () => void;
  onOpened: () => void;
}

export function Wizard({ patient, plan, session, feed, account, onSigned, onOpened }: Props) {
  const [answers, setAnswers] = useState<Answers>(() => firstAnswers(patient, plan?.exercises ?? null));
  const [gone, setGone] = useState<Step | null>(session?.patient_id === patient.id ? "range" : null);
  const own = session?.patient_id === patient.id ? session : null;
  const workspace = useWorkspace(own, gone === "range");
  const facts = useFacts(feed, patient, {
    confirmedSide: answers.side,
    choice: answers.choice,
    isOpen: own !== null,
    isRangeTaken: workspace.value?.workspace.source === "shown",
  });
  const doing = useDoing();
  // Until somebody presses something, the wizard shows the first step that needs a person.
  const at = gone ?? firstToDo(facts);
  const opening = useOpening(patient, answers, doing, () => {
    setGone("range");
    onOpened();
  });
  const answer = (given: Partial<Answers>) => {
    setGone(at);
    setAnswers((before) => ({ ...before, ...given }));
  };
  useLeavingOnceItMoves(feed, own);
  return (
    <>
      <div class="wizard-top">
        <h1>{t("prepare.title", { name: patient.name })}</h1>
        <a class="button" href={hrefOf({ page: "patient", id: patient.id })}>
          {t(own ? "wizard.to-patient" : "action.cancel")}
        </a>
      </div>
      {own && <OpenHead session={own} feed={feed} account={account} />}
      {session && !own && <Other session={session} />}
      <div class="wizard-parts">
        <Rail facts={facts} at={at} onGo={setGone} />
        <section class="card wizard-step" aria-label={t(`wizard.${at}`)} data-testid="wizard-step" data-step={at}>
          <StepView
            step={at}
            facts={facts}
            patient={patient}
            plan={plan}
            session={own}
            feed={feed}
            answers={answers}
            answer={answer}
            onChoose={(person) => choose(choiceOf(person), own, doing, answer)}
            onSigned={onSigned}
            workspace={workspace.value}
            onTaken={() => {
              workspace.again();
              setGone("ready");
            }}
          />
          <ProblemBox problem={doing.problem} onClose={doing.forget} />
          <Foot at={at} facts={facts} isFree={session === null} busy={doing.busy} onGo={setGone} onOpen={opening} />
        </section>
        <Picture step={at} facts={facts} feed={feed} />
      </div>
    </>
  );
}

/** Another patient's session must be ended first: there is one arm. */
function Other({ session }: { session: Session }) {
  return (
    <div class="notice wizard-other" role="alert">
      <span aria-hidden="true">⚠</span>
      <span>{t("wizard.other", { name: session.patient_name })}</span>
      <a class="button" href={hrefOf({ page: "live" })}>
        {t("session.go-on")}
      </a>
    </div>
  );
}

/** Before the session is open the choice is kept; afterwards the station is told at once. */
function choose(choice: Choice | null, own: Session | null, doing: Doing, answer: (given: Partial<Answers>) => void) {
  if (!choice) return;
  if (!own) return answer({ choice });
  doing.run(async () => {
    await followBody(own.id, choice.sensor, choice.body);
    answer({ choice });
  });
}

/** Opens the session, then says who of several people the patient is. */
function useOpening(patient: Patient, answers: Answers, doing: Doing, onOpened: () => void): () => void {
  return () =>
    doing.run(async () => {
      const form = formOf(patient, answers);
      if (!form) return;
      const session = await openSession(form);
      onOpened();
      if (answers.choice) await followBody(session.id, answers.choice.sensor, answers.choice.body);
    });
}

/** Preparing is over once the arm moves. */
function useLeavingOnceItMoves(feed: Feed, own: Session | null): void {
  const moves = useFromFeed(feed, 10, ({ newest }) => newest?.tick.state === "engaged");
  useEffect(() => {
    if (moves && own) go({ page: "live" });
  }, [moves, own]);
}
