// Before a session opens: which arm is affected, confirmed on screen, and how much it hurts.
import { useState } from "preact/hooks";
import { openSession, readPatient } from "../../api/client";
import type { Assistance, Patient, Side } from "../../api/types";
import { type Key, t } from "../../strings";
import { useAsked, useDoing } from "../hooks";
import { ProblemBox } from "../problem";
import { go, hrefOf } from "../route";
import { HelpQuestion } from "./help-question";
import { missingFor } from "./missing";
import { PainScale } from "./pain-scale";
import { SideQuestion } from "./side-question";

/** The one game so far; where there are several, this page is where one is chosen. */
const GAME = "reach";
const MINUTES = 6;

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
  const [assistance, setAssistance] = useState<Assistance>(patient.assistance ?? "passive");
  const [help, setHelp] = useState(patient.assist_level_most ?? 1);
  const missing = missingFor(patient, side);
  const doing = useDoing();
  const open = () =>
    doing.run(async () => {
      if (!side) return;
      await openSession({
        patient_id: patient.id,
        confirmed_affected_side: side,
        pain_before: pain,
        exercises: [{ game: GAME, minutes: MINUTES, level, pinned: false }],
        assistance,
        assist_level: help,
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
      <div class="columns">
        <HelpQuestion
          mode={assistance}
          level={help}
          most={patient.assist_level_most ?? 1}
          onMode={setAssistance}
          onLevel={setHelp}
        />
        <LevelQuestion level={level} onLevel={setLevel} />
      </div>
      {missing.length > 0 && <Missing patient={patient} keys={missing} />}
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
      <div class="row">
        <button
          type="button"
          class="primary big"
          disabled={doing.busy || missing.length > 0}
          onClick={open}
          data-testid="begin-session"
        >
          {t("session.open")}
        </button>
        <a class="button" href={hrefOf({ page: "patient", id: patient.id })}>
          {t("action.cancel")}
        </a>
      </div>
    </>
  );
}

function Missing({ patient, keys }: { patient: Patient; keys: readonly Key[] }) {
  return (
    <section class="notice" aria-label={t("prepare.missing")} data-testid="missing">
      <span aria-hidden="true">⚠</span>
      <div>
        <strong>{t("prepare.missing")}</strong>
        <ul>
          {keys.map((key) => (
            <li key={key}>{t(key)}</li>
          ))}
        </ul>
        {!patient.limits_set_by && (
          <a class="button" href={hrefOf({ page: "patient", id: patient.id })}>
            {t("prepare.limits.go")}
          </a>
        )}
      </div>
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
