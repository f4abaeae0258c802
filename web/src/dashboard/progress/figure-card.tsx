// One figure over the sessions, with the band in which a change may be chance, and in words what can be said.
import { useState } from "preact/hooks";
import { listMeasures } from "../../api/client";
import type { ProgressLine, Side } from "../../api/types";
import { t } from "../../strings";
import { useAsked } from "../hooks";
import { translatedOr } from "../session/metrics";
import { type ChartLine, type Span, TimeChart, Wide } from "../time-chart";
import { amount, type Family, familyName, firstFamilies, mainLine, shownIn, verdictSign, verdictWords } from "./lines";
import { MeasureSources } from "./sources";

const HEIGHT = 280;

interface Props {
  families: readonly Family[];
  affected: Side;
  days: Span;
}

export function FigureCard({ families, affected, days }: Props) {
  const first = firstFamilies(families);
  const measures = useAsked(listMeasures, "measures").value;
  const [chosen, setChosen] = useState(first[0]?.id ?? families[0]?.id ?? "");
  const family = families.find(({ id }) => id === chosen) ?? families[0];
  if (!family) return null;
  const measure = measures?.find(({ name }) => name === family.name);
  return (
    <section class="card" data-testid="progress-figure" data-family={family.id}>
      <div class="heading">
        <h2>{familyName(family)}</h2>
        <label class="progress-choose">
          {t("progress.choose")}
          <select
            value={family.id}
            onChange={(event) => setChosen(event.currentTarget.value)}
            data-testid="choose-figure"
          >
            {families.map((one) => (
              <option key={one.id} value={one.id}>
                {familyName(one)}
              </option>
            ))}
          </select>
        </label>
      </div>
      <fieldset class="row" aria-label={t("progress.first")}>
        {first.map((one) => (
          <button
            key={one.id}
            type="button"
            class="choice choice-low progress-first"
            aria-pressed={one.id === family.id}
            onClick={() => setChosen(one.id)}
          >
            {familyName(one)}
          </button>
        ))}
      </fieldset>
      <FigureChart family={family} affected={affected} days={days} />
      <Said family={family} affected={affected} />
      {measure && <MeasureSources measure={measure} />}
    </section>
  );
}

function FigureChart({ family, affected, days }: { family: Family; affected: Side; days: Span }) {
  const main = mainLine(family, affected);
  if (!main) return null;
  return (
    <>
      <div class="row">
        {family.lines.map((line) => (
          <span key={line.side} class={lookOf(line, affected) === "affected" ? "key key-affected" : "key"}>
            {armName(line, affected)}
          </span>
        ))}
        {main.mdc !== null && (
          <span class="progress-band-key small">{t("progress.band", { mdc: amount(main, main.mdc) })}</span>
        )}
      </div>
      <Wide>
        {(width) => (
          <TimeChart
            width={width}
            height={HEIGHT}
            days={days}
            lines={chartLines(family, affected)}
            band={bandOf(main)}
            sign={shownIn(main).sign}
            label={`${familyName(family)}: ${verdictWords(main)}`}
          />
        )}
      </Wide>
    </>
  );
}

/** What is said of each arm, and how far the sensors can be trusted for it. */
function Said({ family, affected }: { family: Family; affected: Side }) {
  const main = mainLine(family, affected);
  if (!main) return null;
  const why = translatedOr(main.trust_key, "");
  return (
    <>
      <ul class="progress-said">
        {family.lines.map((line) => (
          <li key={line.side} data-testid="verdict" data-verdict={line.verdict}>
            <strong>
              <span aria-hidden="true">{verdictSign(line)} </span>
              {family.lines.length > 1 && `${armName(line, affected)}: `}
              {t("progress.from-to", {
                first: amount(line, line.points[0]?.value ?? null),
                last: amount(line, line.points.at(-1)?.value ?? null),
              })}
            </strong>{" "}
            {verdictWords(line)}
          </li>
        ))}
      </ul>
      <p class="small" data-testid="trust">
        <strong>{t("progress.trust", { word: t(`trust.${main.trust}`) })}</strong> {why}{" "}
        {main.mdc !== null && t(main.mdc_is_published ? "progress.mdc.published" : "progress.mdc.own")}
      </p>
    </>
  );
}

export function lookOf({ side }: Pick<ProgressLine, "side">, affected: Side): "affected" | "healthy" {
  return side === affected ? "affected" : "healthy";
}

export function armName({ side }: Pick<ProgressLine, "side">, affected: Side): string {
  if (!side) return t("progress.patient");
  return t(side === affected ? "arm.affected" : "arm.healthy");
}

export function chartLines(family: Family, affected: Side): ChartLine[] {
  return family.lines.map((line) => ({
    look: lookOf(line, affected),
    points: line.points.map(({ at, value }) => ({ at_ms: Date.parse(at), value: value * shownIn(line).times })),
  }));
}

/** Around the first session: a value outside it differs from the first by more than chance. */
export function bandOf({ points: [first], mdc, ...line }: ProgressLine): Span | null {
  if (!first || mdc === null) return null;
  const { times } = shownIn({ points: [], mdc, ...line });
  return { from: (first.value - mdc) * times, to: (first.value + mdc) * times };
}
