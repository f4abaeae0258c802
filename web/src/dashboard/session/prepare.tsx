// Before a session opens: which arm is affected, confirmed on screen, and how much it hurts.
import { useState } from "preact/hooks";
import { openSession, readPatient } from "../../api/client";
import { otherSide, type Patient, type Side } from "../../api/types";
import { t } from "../../strings";
import { useAsked, useDoing } from "../hooks";
import { ProblemBox } from "../problem";
import { go, hrefOf } from "../route";
import { ArmPicture } from "./arm-picture";
import { PainScale } from "./pain-scale";

/** The one game so far; where there are several, this page is where one is chosen. */
const GAME = "reach";

const LEVELS = [
  { id: "gentle", level: 0.1 },
  { id: "middle", level: 0.3 },
  { id: "brisk", level: 0.6 },
] as const;
const FIRST_LEVEL = 0.3;

export function PreparePage({ id }: { id: number }) {
  const patient = useAsked(() => readPatient(id), id);
  return (
    <main class="page">
      <ProblemBox problem={patient.problem} onRetry={patient.again} />
      {patient.value && <Prepare patient={patient.value} />}
    </main>
  );
}

function Prepare({ patient }: { patient: Patient }) {
  const [side, setSide] = useState<Side | null>(null);
  const [pain, setPain] = useState<number | null>(null);
  const [level, setLevel] = useState(FIRST_LEVEL);
  const doing = useDoing();
  const open = () =>
    doing.run(async () => {
      if (!side) return;
      await openSession({
        patient_id: patient.id,
        confirmed_affected_side: side,
        pain_before: pain,
        level,
        game: GAME,
      });
      go({ page: "live" });
    });
  return (
    <>
      <h1>{t("prepare.title", { name: patient.name })}</h1>
      <SideQuestion patient={patient} side={side} onChoose={setSide} />
      <section class="card">
        <h2>{t("prepare.pain")}</h2>
        <PainScale value={pain} onChange={setPain} />
      </section>
      <LevelQuestion level={level} onLevel={setLevel} />
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
      <div class="row">
        <button
          type="button"
          class="primary big"
          disabled={doing.busy || !side}
          onClick={open}
          data-testid="begin-session"
        >
          {t("session.open")}
        </button>
        <a class="button" href={hrefOf({ page: "patient", id: patient.id })}>
          {t("action.cancel")}
        </a>
        {!side && <span class="soft">{t("prepare.side.missing")}</span>}
      </div>
    </>
  );
}

interface SideProps {
  patient: Patient;
  side: Side | null;
  onChoose: (side: Side) => void;
}

function SideQuestion({ patient, side, onChoose }: SideProps) {
  const differs = side !== null && side === patient.healthy_side;
  return (
    <section class="card">
      <h2>{t("prepare.side")}</h2>
      <p class="soft">{t("prepare.side.hint")}</p>
      <div class="choices">
        {(["left", "right"] as const).map((one) => (
          <button
            key={one}
            type="button"
            class="choice"
            aria-pressed={side === one}
            onClick={() => onChoose(one)}
            data-testid={`confirm-side-${one}`}
          >
            <ArmPicture side={one} />
            {t(`prepare.side.${one}`)}
          </button>
        ))}
      </div>
      {differs && (
        <p class="notice" role="alert">
          {t("prepare.side.differs", { side: t(`side.${otherSide(patient.healthy_side)}`) })}
        </p>
      )}
    </section>
  );
}

function LevelQuestion({ level, onLevel }: { level: number; onLevel: (level: number) => void }) {
  return (
    <section class="card">
      <h2>{t("prepare.level")}</h2>
      <div class="choices">
        {LEVELS.map((one) => (
          <button
            key={one.id}
            type="button"
            aria-pressed={level === one.level}
            class="choice choice-low"
            onClick={() => onLevel(one.level)}
          >
            {t(`prepare.level.${one.id}`)}
          </button>
        ))}
      </div>
    </section>
  );
}
