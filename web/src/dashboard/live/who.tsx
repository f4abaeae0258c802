// Who of the people in view is the patient: asked where several are there, and whenever the therapist wants to say it.
import { useEffect, useState } from "preact/hooks";
import { followBody } from "../../api/client";
import type { SensorView } from "../../api/types";
import { t } from "../../strings";
import { sentence } from "../format";
import { useDoing } from "../hooks";
import { ProblemBox } from "../problem";
import { type Feed, useFromFeed } from "./feed";
import { FloorPlan } from "./floor-plan";
import { bodyToChoose, isOpenQuestion, type Person, peopleOf } from "./people";
import "./who.css";

export interface Question {
  isShown: boolean;
  isConfirmed: boolean;
  ask: () => void;
  close: () => void;
}

/** Whether it is asked: by itself once for every company, or because somebody pressed the button. */
export function useWho(feed: Feed): Question {
  const isOpen = useFromFeed(feed, 4, (now) => isOpenQuestion(peopleIn(now)));
  const isConfirmed = useFromFeed(feed, 4, (now) => peopleIn(now).some((person) => person.isConfirmed));
  const [asked, setAsked] = useState(false);
  const [dismissed, setDismissed] = useState(false);
  useEffect(() => setDismissed(false), [isOpen]);
  const close = () => {
    setAsked(false);
    setDismissed(true);
  };
  return { isShown: asked || (isOpen && !dismissed), isConfirmed, ask: () => setAsked(true), close };
}

export function Who({ feed, session, onClose }: { feed: Feed; session: number; onClose: () => void }) {
  const people = useFromFeed(feed, 4, peopleIn);
  const sensors = useFromFeed(feed, 1, ({ newest }) => newest?.tick.sensors ?? NO_SENSORS);
  const doing = useDoing();
  const choose = (person: Person) =>
    doing.run(async () => {
      const body = bodyToChoose(person);
      if (body) await followBody(session, body.sensor, body.body);
      onClose();
    });
  return (
    <section class="card who" aria-label={t("who.title")} data-testid="who">
      <h2>{t("who.title")}</h2>
      <button type="button" onClick={onClose} data-testid="who-close">
        {t("who.close")}
      </button>
      {people.length === 0 ? <p>{t("who.nobody")}</p> : <FloorPlan people={people} sensors={sensors} />}
      <ul>
        {people.map((person) => (
          <Choice key={person.label} person={person} busy={doing.busy} onChoose={() => choose(person)} />
        ))}
      </ul>
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
    </section>
  );
}

function Choice({ person, busy, onChoose }: { person: Person; busy: boolean; onChoose: () => void }) {
  return (
    <li class={person.isPatient ? "who-patient" : ""} data-testid="person" data-bodies={numbersOf(person)}>
      <span class="who-letter" aria-hidden="true">
        {person.label}
      </span>
      <div>
        <strong class="small">{wordOf(person)}</strong>
        <div class="small soft">{sensorsOf(person)}</div>
      </div>
      {person.isConfirmed ? (
        <span class="who-sure">✓ {t("who.confirmed")}</span>
      ) : (
        <button type="button" class={person.isPatient ? "primary" : ""} disabled={busy} onClick={onChoose}>
          {t("who.choose", { person: person.label })}
        </button>
      )}
    </li>
  );
}

/** What the person is taken for, and why. */
function wordOf(person: Person): string {
  const body = bodyToChoose(person);
  return person.isPatient ? t("who.followed") : sentence(body?.reason ?? "");
}

function numbersOf(person: Person): string {
  return person.bodies.map(({ body }) => body).join(" ");
}

function sensorsOf(person: Person): string {
  return t("who.seen", { sensors: person.bodies.map(({ sensor }) => sensor).join(", ") });
}

const NO_SENSORS: SensorView[] = [];

function peopleIn({ newest }: Feed): Person[] {
  return peopleOf(newest?.tick.people ?? []);
}
