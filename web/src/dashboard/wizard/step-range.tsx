// How far the healthy arm goes today: the games ask no more of the affected one. May be left out.
import { takeWorkspace } from "../../api/client";
import { JOINTS, type Joint, type JointRange, type Side } from "../../api/types";
import { t } from "../../strings";
import { angleText, degrees } from "../format";
import { useDoing } from "../hooks";
import { RangePicture, type Sector } from "../patient/range-picture";
import { ProblemBox } from "../problem";
import type { StepProps } from "./step-view";

export function RangeStep({ session, workspace, patient, facts, onTaken }: StepProps) {
  const doing = useDoing();
  if (!session || !workspace) return <p>{t("wizard.ready.first")}</p>;
  const take = () =>
    doing.run(async () => {
      await takeWorkspace(session.id);
      onTaken();
    });
  return (
    <>
      <p>{t("wizard.range.do", { name: patient.name })}</p>
      <div class="row">
        <button
          type="button"
          disabled={doing.busy || workspace.begun || !workspace.enough}
          onClick={take}
          data-testid="take-range"
        >
          {t("wizard.range.take")}
        </button>
      </div>
      <ul class="wizard-ranges">
        {JOINTS.map((joint) => (
          <li key={joint} data-testid="shown" data-joint={joint}>
            <Shown
              joint={joint}
              shown={workspace.shown?.[joint]}
              allowed={patient.passive_range?.[joint]}
              isEnough={!workspace.missing.includes(joint)}
              side={facts.affectedSide}
            />
          </li>
        ))}
      </ul>
      <p class="soft">{t(workspace.begun ? "wizard.range.begun" : "wizard.range.optional")}</p>
      <p aria-live="polite" data-testid="range-source">
        {t(`wizard.range.source.${workspace.workspace.source}`)}
        {workspace.workspace.pushed && ` ${t("wizard.range.pushed")}`}
      </p>
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
    </>
  );
}

interface ShownProps {
  joint: Joint;
  shown: JointRange | undefined;
  /** The patient's limits. */
  allowed: JointRange | undefined;
  isEnough: boolean;
  side: Side;
}

function Shown({ joint, shown, allowed, isEnough, side }: ShownProps) {
  return (
    <>
      <RangePicture joint={joint} side={side} sectors={[...sector(allowed, "limit"), ...sector(shown, "last")]} />
      <span>
        <strong class="small">{t(`joint.${joint}`)}</strong>
        <span class={isEnough ? "small wizard-fine" : "small soft"}>
          {shown ? `${angleText(shown.min_rad)} … ${angleText(shown.max_rad)} ` : ""}
          {isEnough ? "✓" : t("wizard.range.more")}
        </span>
      </span>
    </>
  );
}

function sector(range: JointRange | undefined, look: Sector["look"]): Sector[] {
  return range ? [{ minDeg: degrees(range.min_rad), maxDeg: degrees(range.max_rad), look }] : [];
}
