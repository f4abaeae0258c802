// What happened in a session, in order.
import type { SessionEvent } from "../../api/types";
import { isKey, t } from "../../strings";
import { clockTime, figure, sentence } from "../format";
import { Scroll } from "../scroll";
import { translatedOr } from "./metrics";

export function EventList({ events }: { events: readonly SessionEvent[] }) {
  return (
    <section class="card">
      <h2>{t("events.title")}</h2>
      {events.length === 0 && <p class="soft">{t("events.none")}</p>}
      <Scroll label={t("events.title")} look="events">
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
      </Scroll>
    </section>
  );
}

function kindOf(event: SessionEvent): string {
  if (event.kind === "state") return `${stateOf(event.data?.before)} → ${stateOf(event.data?.after)}`;
  return translatedOr(`event.${event.kind}`, event.kind);
}

/** Buttons, wishes and attempts are told by words that have their own text; all else is a sentence. */
function textOf({ kind, text, data }: SessionEvent): string {
  if (kind === "control") return translatedOr(`control.${text}`, text);
  if (kind === "game") return translatedOr(`event.game.${text}`, text);
  if (kind === "assistance") return helpOf(data?.mode, data?.level);
  return kind === "score" ? attemptOf(text) : sentence(text);
}

/** A game has words of its own besides; whether it succeeded is what matters here. */
function attemptOf(words: string): string {
  const [known] = words.split(", ").filter((word) => isKey(`event.score.${word}`));
  return known ? translatedOr(`event.score.${known}`, known) : "";
}

function helpOf(mode: unknown, level: unknown): string {
  const name = translatedOr(`help.${mode}`, String(mode));
  return mode === "assisted" ? t("event.assistance.most", { name, most: figure(100 * Number(level)) }) : name;
}

function stateOf(state: unknown): string {
  return translatedOr(`state.${state}`, String(state));
}
