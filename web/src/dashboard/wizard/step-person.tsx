// Is it the patient whom the sensors see?
import type { Patient } from "../../api/types";
import { t } from "../../strings";
import type { Person } from "../live/people";
import { PeopleList } from "../live/people-list";
import type { Facts } from "./steps";

interface Props {
  facts: Facts;
  patient: Patient;
  onChoose: (person: Person) => void;
}

export function PersonStep({ facts: { people }, patient, onChoose }: Props) {
  if (people.length === 0) {
    return (
      <div class="notice">
        <span aria-hidden="true">⚠</span>
        <div>
          <strong>{t("who.nobody")}</strong>
          <p>{t("wizard.person.none.do")}</p>
        </div>
      </div>
    );
  }
  return (
    <>
      <p>{t(people.length > 1 ? "wizard.person.several.do" : "wizard.person.one", { name: patient.name })}</p>
      <PeopleList people={people} busy={false} onChoose={onChoose} />
    </>
  );
}
