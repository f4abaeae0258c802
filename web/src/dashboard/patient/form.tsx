// Enrolling a patient, and changing what is known of one.
import { useState } from "preact/hooks";
import { changePatient, enrolPatient, readCautiousRange, readPatient } from "../../api/client";
import { JOINTS, type Joint, otherSide, type Patient, type PatientForm, type Side } from "../../api/types";
import { t } from "../../strings";
import { type Asked, useAsked, useDoing } from "../hooks";
import { ProblemBox } from "../problem";
import { go, hrefOf } from "../route";
import { type Draft, draftOf, emptyDraft, formOf, LARGEST_DEG, type RangeDraft, rangeDeg } from "./draft";
import { RangePicture } from "./range-picture";

export function EnrolPatient() {
  const range = useAsked(readCautiousRange, "range");
  if (!range.value) return <NotYet asked={range} />;
  const first = emptyDraft(range.value);
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
          <Person draft={draft} change={change} />
          <Ranges draft={draft} change={change} />
        </div>
        <ProblemBox problem={doing.problem} onClose={doing.forget} />
        <div class="row">
          <button type="submit" class="primary big" disabled={doing.busy || !form} data-testid="save-patient">
            {t("action.save")}
          </button>
          <a class="button" href={back}>
            {t("action.cancel")}
          </a>
          {!form && <span class="soft">{t("patient.incomplete")}</span>}
        </div>
      </form>
    </main>
  );
}

interface PartProps {
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

function Ranges({ draft, change }: PartProps) {
  const affected = otherSide(draft.healthySide ?? "left");
  return (
    <section class="card">
      <h2>{t("range.title")}</h2>
      <p class="soft small">{t("range.why")}</p>
      {JOINTS.map((joint) => (
        <RangeField
          key={joint}
          joint={joint}
          side={affected}
          range={draft.range[joint]}
          onChange={(range) => change({ range: { ...draft.range, [joint]: range } })}
        />
      ))}
    </section>
  );
}

interface RangeFieldProps {
  joint: Joint;
  side: Side;
  range: RangeDraft;
  onChange: (range: RangeDraft) => void;
}

function RangeField({ joint, side, range, onChange }: RangeFieldProps) {
  const usable = rangeDeg(range);
  const [min, max] = usable ?? [0, 0];
  return (
    <div class="range">
      <RangePicture joint={joint} side={side} minDeg={min} maxDeg={max} />
      <div class="field">
        <h3>{t(`joint.${joint}`)}</h3>
        <span class="hint">{t(`range.${joint}.hint`)}</span>
        <div class="range-inputs">
          <Degrees name={t("range.from")} value={range.min} onInput={(value) => onChange({ ...range, min: value })} />
          <Degrees name={t("range.to")} value={range.max} onInput={(value) => onChange({ ...range, max: value })} />
        </div>
        {!usable && <span class="small caveat">{t("range.wrong")}</span>}
      </div>
    </div>
  );
}

function Degrees({ name, value, onInput }: { name: string; value: string; onInput: (value: string) => void }) {
  return (
    <label class="hint">
      {name}
      <input
        type="number"
        min={-LARGEST_DEG}
        max={LARGEST_DEG}
        step="1"
        value={value}
        onInput={(event) => onInput(event.currentTarget.value)}
      />
    </label>
  );
}
