// Which arm, how much it hurts, and what is done today.
import { listGames } from "../../api/client";
import type { Side } from "../../api/types";
import { t } from "../../strings";
import { useAsked } from "../hooks";
import { ProblemBox } from "../problem";
import { hrefOf } from "../route";
import { HelpQuestion } from "../session/help-question";
import { PainScale } from "../session/pain-scale";
import { Programme } from "../session/programme";
import { SideQuestion } from "../session/side-question";
import type { StepProps } from "./step-view";

export function ArmStep({ patient, plan, session, answers, answer }: StepProps) {
  if (session) return <Fixed side={session.affected_side} />;
  return (
    <>
      <SideQuestion patient={patient} side={answers.side} onChoose={(side) => answer({ side })} />
      <section class="question">
        <h3>{t("prepare.pain")}</h3>
        <PainScale value={answers.painBefore} onChange={(painBefore) => answer({ painBefore })} />
      </section>
      <Today plan={plan} patient={patient} answers={answers} answer={answer} />
      <HelpQuestion
        mode={answers.assistance}
        level={answers.help}
        most={patient.assist_level_most ?? 1}
        onMode={(assistance) => answer({ assistance })}
        onLevel={(help) => answer({ help })}
      />
    </>
  );
}

/** An open session keeps its side and its programme. */
function Fixed({ side }: { side: Side }) {
  return (
    <>
      <p>{t("wizard.arm.fixed", { arm: t(`prepare.side.${side}`) })}</p>
      <div class="row">
        <a class="button" href={hrefOf({ page: "live" })}>
          {t("session.go-on")}
        </a>
      </div>
    </>
  );
}

function Today({ plan, patient, answers, answer }: Pick<StepProps, "plan" | "patient" | "answers" | "answer">) {
  const games = useAsked(listGames, "games");
  return (
    <section class="question">
      <h3>{t("programme.title")}</h3>
      <p class="soft small">
        {t(plan ? "programme.planned" : "programme.unplanned")}{" "}
        <a class="wizard-link" href={hrefOf({ page: "plan", id: patient.id })}>
          {t(plan ? "programme.plan" : "programme.make")}
        </a>
      </p>
      <Programme
        games={games.value?.map(({ name }) => name) ?? []}
        exercises={answers.exercises}
        onChange={(exercises) => answer({ exercises })}
      />
      <ProblemBox problem={games.problem} onRetry={games.again} />
    </section>
  );
}
