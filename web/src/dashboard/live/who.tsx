// Who of the people in view is the patient: asked where several are there, and whenever the therapist wants to say it.
import { useEffect, useState } from "preact/hooks";
import { followBody } from "../../api/client";
import type { SensorView } from "../../api/types";
import { t } from "../../strings";
import { useDoing } from "../hooks";
import { ProblemBox } from "../problem";
import { type Feed, useFromFeed } from "./feed";
import { FloorPlan } from "./floor-plan";
import { bodyToChoose, isOpenQuestion, type Person, peopleOf } from "./people";
import { PeopleList } from "./people-list";
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
      <PeopleList people={people} busy={doing.busy} onChoose={choose} />
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
    </section>
  );
}

const NO_SENSORS: SensorView[] = [];

function peopleIn({ newest }: Feed): Person[] {
  return peopleOf(newest?.tick.people ?? []);
}
