// Where a number comes from: formula, filter, publications. The service says it in English, as the publications do.
import type { Measure, Scale } from "../../api/types";
import { t } from "../../strings";

export function MeasureSources({ measure }: { measure: Measure }) {
  return (
    <Sources
      rows={[
        [t("sources.formula"), measure.formula],
        [t("sources.unit"), measure.unit],
        [t("sources.filter"), measure.filter],
        [t("sources.source"), measure.source],
        ...(measure.mdc ? [[t("sources.mdc"), publishedText(measure.mdc)] as const] : []),
        ...(measure.mcid ? [[t("sources.mcid"), publishedText(measure.mcid)] as const] : []),
      ]}
    />
  );
}

export function ScaleSources({ scales }: { scales: readonly Scale[] }) {
  return (
    <Sources
      rows={scales.flatMap(({ name, source, mdc, mcid }) => [
        [name, source] as const,
        ...(mdc ? [[`${name}: ${t("sources.mdc")}`, publishedText(mdc)] as const] : []),
        ...mcid.map((one) => [`${name}: ${t("sources.mcid")}`, publishedText(one)] as const),
      ])}
    />
  );
}

function Sources({ rows }: { rows: readonly (readonly [string, string])[] }) {
  return (
    <details class="sources" data-testid="sources">
      <summary>{t("sources.title")}</summary>
      <dl>
        {rows.map(([name, text]) => (
          <div key={name + text}>
            <dt>{name}</dt>
            <dd lang="en">{text}</dd>
          </div>
        ))}
      </dl>
    </details>
  );
}

function publishedText({ value, of_whom, source }: NonNullable<Scale["mdc"]>): string {
  return [`${value}`, of_whom, source].filter(Boolean).join("; ");
}
