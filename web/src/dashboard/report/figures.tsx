// The tables of figures in reports.
import type { ProgressLine, Side } from "../../api/types";
import { t } from "../../strings";
import { armName } from "../progress/figure-card";
import { amount, type Family, familyName } from "../progress/lines";
import { FigureTable } from "../progress/table";

interface Props {
  rows: readonly { family: Family; line: ProgressLine }[];
  affected: Side;
}

/** This session beside the first one. */
export function SessionFigures({ rows, affected }: Props) {
  if (rows.length === 0) return <p>{t("figures.none")}</p>;
  return (
    <table>
      <thead>
        <tr>
          <th>{t("progress.figure")}</th>
          <th class="number">{t("report.this-session")}</th>
          <th class="number">{t("report.first-session")}</th>
          <th class="number">{t("progress.mdc")}</th>
          <th>{t("progress.trusted")}</th>
        </tr>
      </thead>
      <tbody>
        {rows.map(({ family, line }) => (
          <tr key={family.id}>
            <Name family={family} line={line} affected={affected} />
            <td class="number">
              <strong>{amount(line, line.points.at(-1)?.value ?? null)}</strong>
            </td>
            <td class="number">{line.points.length > 1 ? amount(line, line.points[0]?.value ?? null) : "–"}</td>
            <td class="number">{amount(line, line.mdc)}</td>
            <td>{t(`trust.${line.trust}`)}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

/** From the first session to the last, and what can be said of it. */
export function CourseFigures({ rows, affected }: Props) {
  return rows.length === 0 ? <p>{t("progress.none")}</p> : <FigureTable rows={rows} affected={affected} />;
}

function Name({ family, line, affected }: { family: Family; line: ProgressLine; affected: Side }) {
  return (
    <th scope="row">
      {familyName(family)}
      {line.side && ` (${armName(line, affected)})`}
    </th>
  );
}
