// What happened in a session, in order.
import type { SessionEvent } from "../../api/types";
import { t } from "../../strings";
import { clockTime, sentence } from "../format";
import { translatedOr } from "./metrics";

export function EventList({ events }: { events: readonly SessionEvent[] }) {
  return (
    <section class="card">
      <h2>{t("events.title")}</h2>
      {events.length === 0 && <p class="soft">{t("events.none")}</p>}
      <div class="table-scroll">
        <table>
          <tbody>
            {events.map((event) => (
              <tr key={event.id}>
                <td class="event-time">{clockTime(event.t)}</td>
                <td class="event-kind">{kindOf(event)}</td>
                <td>{sentence(event.text)}</td>
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

function stateOf(state: unknown): string {
  return translatedOr(`state.${state}`, String(state));
}
