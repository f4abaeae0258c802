// Enrolling a patient, and changing what is known of one.
import { useState } from "preact/hooks";
import { changePatient, enrolPatient, readCautiousLimits, readPatient } from "../../api/client";
import { otherSide, type Patient, type PatientForm, type Side } from "../../api/types";
import { t } from "../../strings";
import { type Asked, useAsked, useDoing } from "../hooks";
import { ProblemBox } from "../problem";
import { go, hrefOf } from "../route";
import { type Draft, draftOf, emptyDraft, formOf } from "./draft";
import { HelpFields } from "./help-fields";
import { JointFields } from "./joint-fields";

export function EnrolPatient() {
  const limits = useAsked(readCautiousLimits, "limits");
  if (!limits.value) return <NotYet asked={limits} />;
  const first = emptyDraft(limits.value);
  return <Form title={t("patient.new")} first={first} send={enrolPatient} back={hrefOf({ page: "patients" })} />;
}

export function ChangePatient({ id }: { id: number }) {
  const patient = useAsked(() => readPatient(id), id);
  if (!patient.value) return <NotYet asked={patient} />;
  return (
    <Form
      title={patient.value.name}
      first={draftOf(patient.value)}
      send={(form) => changePatient(id, form)}
      back={hrefOf({ page: "patient", id })}
    />
  );
}

function NotYet({ asked }: { asked: Asked<unknown> }) {
  return (
    <main class="page">
      <ProblemBox problem={asked.problem} onRetry={asked.again} />
    </main>
  );
}

interface FormProps {
  title: string;
  first: Draft;
  send: (form: PatientForm) => Promise<Patient>;
  back: string;
}

function Form({ title, first, send, back }: FormProps) {
  const [draft, setDraft] = useState(first);
  const doing = useDoing();
  const change = (part: Partial<Draft>) => setDraft((before) => ({ ...before, ...part }));
  const form = formOf(draft);
  const submit = (event: Event) => {
    event.preventDefault();
    if (form) doing.run(async () => go({ page: "patient", id: (await send(form)).id }));
  };
  return (
    <main class="page">
      <h1>{title}</h1>
      <form class="card-form" onSubmit={submit}>
        <div class="columns">
          <div class="column">
            <Person draft={draft} change={change} />
            <HelpFields draft={draft} change={change} />
          </div>
          <JointFields draft={draft} change={change} />
        </div>
        <ProblemBox problem={doing.problem} onClose={doing.forget} />
        <div class="row">
          <button type="submit" class="primary big" disabled={doing.busy || !form} data-testid="save-patient">
            {t("action.save")}
          </button>
          <a class="button" href={back}>
            {t("action.cancel")}
          </a>
          <span class="soft">{t(form ? "patient.then-confirm" : "patient.incomplete")}</span>
        </div>
      </form>
    </main>
  );
}

export interface PartProps {
  draft: Draft;
  change: (part: Partial<Draft>) => void;
}

function Person({ draft, change }: PartProps) {
  return (
    <section class="card">
      <label>
        {t("patient.name")}
        <span class="hint">{t("patient.name.hint")}</span>
        <input
          required
          maxLength={120}
          value={draft.name}
          onInput={(event) => change({ name: event.currentTarget.value })}
          data-testid="patient-name"
        />
      </label>
      <div class="field">
        <span id="healthy-side">{t("patient.healthy")}</span>
        <span class="hint">{t("patient.healthy.hint")}</span>
        <fieldset class="choices" aria-labelledby="healthy-side">
          {(["left", "right"] as const).map((side) => (
            <SideButton key={side} side={side} draft={draft} change={change} />
          ))}
        </fieldset>
      </div>
      <label>
        {t("patient.notes")}
        <textarea
          maxLength={10_000}
          value={draft.notes}
          onInput={(event) => change({ notes: event.currentTarget.value })}
          data-testid="patient-notes"
        />
      </label>
    </section>
  );
}

function SideButton({ side, draft, change }: PartProps & { side: Side }) {
  return (
    <button
      type="button"
      class="choice"
      aria-pressed={draft.healthySide === side}
      onClick={() => change({ healthySide: side })}
      data-testid={`healthy-${side}`}
    >
      {t(`side.${side}`)}
      <span class="small">{t(`patient.affected.${otherSide(side)}`)}</span>
    </button>
  );
}
