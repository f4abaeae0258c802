// Every figure at a glance: first, last, what changed, what is said of it.
import type { ProgressLine, Side } from "../../api/types";
import { t } from "../../strings";
import { Scroll } from "../scroll";
import { armName } from "./figure-card";
import { amount, type Family, familyName, saidOf, signedAmount, verdictSign } from "./lines";

interface Props {
  families: readonly Family[];
  affected: Side;
}

export function AllFigures({ families, affected }: Props) {
  return (
    <section class="card" data-testid="all-figures">
      <h2>{t("progress.all")}</h2>
      <p class="small soft">{t("progress.all.how")}</p>
      <Scroll label={t("progress.all")}>
        <FigureTable
          rows={families.flatMap((family) => family.lines.map((line) => ({ family, line })))}
          affected={affected}
        />
      </Scroll>
    </section>
  );
}

export interface TableRow {
  family: Family;
  line: ProgressLine;
}

export function FigureTable({ rows, affected }: { rows: readonly TableRow[]; affected: Side }) {
  return (
    <table class="figure-table">
      <thead>
        <tr>
          <th>{t("progress.figure")}</th>
          <th class="number">{t("progress.first-value")}</th>
          <th class="number">{t("progress.last-value")}</th>
          <th class="number">{t("progress.difference")}</th>
          <th class="number">{t("progress.mdc")}</th>
          <th>{t("progress.said")}</th>
          <th>{t("progress.trusted")}</th>
        </tr>
      </thead>
      <tbody>
        {rows.map(({ family, line }) => (
          <tr key={`${family.id}${line.side}`} data-testid="progress-row" data-figure={family.id}>
            <th scope="row">
              {familyName(family)}
              {family.lines.length > 1 && <div class="small soft">{armName(line, affected)}</div>}
            </th>
            <td class="number">{amount(line, line.points[0]?.value ?? null)}</td>
            <td class="number">{amount(line, line.points.at(-1)?.value ?? null)}</td>
            <td class="number">{signedAmount(line, line.difference)}</td>
            <td class="number">{amount(line, line.mdc)}</td>
            <td>
              <span aria-hidden="true">{verdictSign(line)}</span> {t(`progress.verdict.${saidOf(line)}.short`)}
            </td>
            <td>{t(`trust.${line.trust}`)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
