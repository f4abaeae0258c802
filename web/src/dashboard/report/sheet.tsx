// One page of A4 on the screen and on paper: what it is of, what it says, and what it is not.
import type { ComponentChildren } from "preact";
import { useEffect } from "preact/hooks";
import { readStatus } from "../../api/client";
import { t } from "../../strings";
import { dateAndTime } from "../format";
import { useAsked } from "../hooks";
import { useFit } from "./fit";
import "./report.css";

interface Props {
  title: string;
  /** The patient's pseudonym. */
  name: string;
  /** In a line: which arm, which days. */
  subject: string;
  children: ComponentChildren;
}

export function Sheet({ title, name, subject, children }: Props) {
  const sheet = useFit();
  useTitle(`${name} – ${title}`);
  return (
    <article class="sheet" ref={sheet} data-testid="report">
      <header class="sheet-head">
        <div>
          <h1>{title}</h1>
          <p class="sheet-name">{name}</p>
          <p>{subject}</p>
        </div>
        <p class="sheet-brand">{t("app.name")}</p>
      </header>
      {children}
      <Foot />
    </article>
  );
}

function Foot() {
  const version = useAsked(readStatus, "version").value?.version ?? "";
  return (
    <footer class="sheet-foot">
      <p>
        <strong>{t("app.disclaimer")}</strong> {t("report.not")}
      </p>
      <p>
        {t("app.name")} · {t("app.version", { version })} ·{" "}
        {t("report.printed", { when: dateAndTime(new Date().toISOString()) })}
      </p>
    </footer>
  );
}

/** Above the sheet, and not on paper. */
export function PrintBar({ children }: { children?: ComponentChildren }) {
  return (
    <div class="heading no-print">
      <div class="row">{children}</div>
      <div class="row">
        <span class="small soft">{t("report.hint")}</span>
        <button type="button" class="primary" onClick={() => window.print()} data-testid="print">
          {t("report.print")}
        </button>
      </div>
    </div>
  );
}

/** The page's title is what a browser calls the file. */
function useTitle(title: string): void {
  useEffect(() => {
    const before = document.title;
    document.title = title;
    return () => {
      document.title = before;
    };
  }, [title]);
}
