// The pages of one patient, on each of them.
import { t } from "../../strings";
import { hrefOf, type Route } from "../route";
import "./tabs.css";

const PAGES = ["patient", "plan", "progress", "scores", "course-report"] as const satisfies readonly Route["page"][];
type PatientPageName = (typeof PAGES)[number];

export function PatientTabs({ id, at }: { id: number; at: PatientPageName }) {
  return (
    <nav class="tabs no-print" aria-label={t("patient.pages")}>
      {PAGES.map((page) => (
        <a
          key={page}
          href={hrefOf({ page, id } as Route)}
          aria-current={page === at ? "page" : undefined}
          data-testid={`tab-${page}`}
        >
          {t(`patient.page.${page}`)}
        </a>
      ))}
    </nav>
  );
}
