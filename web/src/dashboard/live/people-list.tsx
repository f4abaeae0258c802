// The people in view by their letters, each with what they are taken for and a button to choose them.
import { t } from "../../strings";
import { sentence } from "../format";
import { bodyToChoose, type Person } from "./people";
import "./people-list.css";

interface Props {
  people: readonly Person[];
  busy: boolean;
  onChoose: (person: Person) => void;
}

export function PeopleList({ people, busy, onChoose }: Props) {
  return (
    <ul class="people">
      {people.map((person) => (
        <Choice key={person.label} person={person} busy={busy} onChoose={() => onChoose(person)} />
      ))}
    </ul>
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
