// What the therapist adds after a session: the pain, and a note. Kept at once, also when the page is left.
import { useState } from "preact/hooks";
import { changeSession } from "../../api/client";
import type { SessionDetail, SessionUpdate } from "../../api/types";
import { t } from "../../strings";
import { useDoing } from "../hooks";
import { ProblemBox } from "../problem";
import { PainScale } from "./pain-scale";

/** The service refuses more. */
const LONGEST_NOTE = 10_000;

interface Props {
  session: SessionDetail;
  onChanged: () => void;
}

export function Afterwards({ session, onChanged }: Props) {
  const [pain, setPain] = useState(session.pain_after ?? null);
  const doing = useDoing();
  const keep = (form: SessionUpdate, onKept: () => void) =>
    doing.run(async () => {
      await changeSession(session.id, form);
      onKept();
      onChanged();
    });
  const feel = (chosen: number | null) => chosen !== null && keep({ pain_after: chosen }, () => setPain(chosen));
  return (
    <section class="card">
      <h2>{t("afterwards.title")}</h2>
      <h3>{t("end.pain")}</h3>
      <PainScale value={pain} onChange={feel} />
      <Note first={session.notes} busy={doing.busy} onKeep={(notes, onKept) => keep({ notes }, onKept)} />
      <ProblemBox problem={doing.problem} onClose={doing.forget} />
    </section>
  );
}

interface NoteProps {
  first: string;
  busy: boolean;
  onKeep: (notes: string, onKept: () => void) => void;
}

function Note({ first, busy, onKeep }: NoteProps) {
  const [kept, setKept] = useState(first);
  const [text, setText] = useState(first);
  const isKept = text === kept;
  const keep = () => {
    if (!isKept) onKeep(text, () => setKept(text));
  };
  return (
    <>
      <label>
        {t("afterwards.note")}
        <textarea
          maxLength={LONGEST_NOTE}
          value={text}
          onInput={(event) => setText(event.currentTarget.value)}
          onBlur={keep}
          data-testid="session-notes"
        />
      </label>
      <div class="row">
        <button type="button" disabled={busy || isKept} onClick={keep} data-testid="save-notes">
          {t("action.save")}
        </button>
        <span class="soft" role="status" data-testid="notes-state">
          {isKept ? text && `✓ ${t("afterwards.kept")}` : t("afterwards.unkept")}
        </span>
      </div>
    </>
  );
}
