// What happened in a session, in order.
import type { SessionEvent } from "../../api/types";
import { t } from "../../strings";
import { clockTime, figure, sentence } from "../format";
import { translatedOr } from "./metrics";

export function EventList({ events }: { events: readonly SessionEvent[] }) {
  return (
    <section class="card">
      <h2>{t("events.title")}</h2>
      {events.length === 0 && <p class="soft">{t("events.none")}</p>}
      <div class="table-scroll events">
        <table>
          <tbody>
            {events.map((event) => (
              <tr key={event.id}>
                <td class="event-time">{clockTime(event.t)}</td>
                <td class="event-kind">{kindOf(event)}</td>
                <td>{textOf(event)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </section>
  );
}

function kindOf(event: SessionEvent): string {
  if (event.kind === "state") return `${stateOf(event.data?.before)} → ${stateOf(event.data?.after)}`;
  return translatedOr(`event.${event.kind}`, event.kind);
}

/** Buttons and targets are told by a word that has its own text; all else is a sentence. */
function textOf({ kind, text, data }: SessionEvent): string {
  if (kind === "control") return translatedOr(`control.${text}`, text);
  if (kind === "assistance") return helpOf(data?.mode, data?.level);
  const [word = ""] = text.split(",", 1);
  return translatedOr(`event.${kind}.${word}`, sentence(text));
}

function helpOf(mode: unknown, level: unknown): string {
  const name = translatedOr(`help.${mode}`, String(mode));
  return mode === "assisted" ? t("event.assistance.most", { name, most: figure(100 * Number(level)) }) : name;
}

function stateOf(state: unknown): string {
  return translatedOr(`state.${state}`, String(state));
}
