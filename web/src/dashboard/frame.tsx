// What surrounds every page: where one is, who is logged in, the language, and what this software is not.
import type { ComponentChildren } from "preact";
import type { Account } from "../api/types";
import { LANGUAGES, language, setLanguage, t } from "../strings";
import { hrefOf } from "./route";

interface Props {
  account: Account | null;
  /** The page shown, as far as the menu knows it. */
  at: "patients" | "live" | null;
  version: string;
  onLogOut: () => void;
  children: ComponentChildren;
}

export function Frame({ account, at, version, onLogOut, children }: Props) {
  return (
    <div class={at === "live" ? "frame frame-live" : "frame"}>
      <header class="top">
        <a class="brand" href={hrefOf({ page: "patients" })}>
          {t("app.name")}
        </a>
        <nav aria-label={t("nav.label")}>{account && <Menu at={at} />}</nav>
        <LanguageSwitch />
        {account && <Who account={account} onLogOut={onLogOut} />}
      </header>
      {children}
      <footer class="foot">
        <span>{t("app.disclaimer")}</span>
        <span>{version && t("app.version", { version })}</span>
      </footer>
    </div>
  );
}

function Menu({ at }: { at: Props["at"] }) {
  return (
    <>
      <a
        href={hrefOf({ page: "patients" })}
        aria-current={at === "patients" ? "page" : undefined}
        data-testid="nav-today"
      >
        {t("nav.patients")}
      </a>
      <a href={hrefOf({ page: "live" })} aria-current={at === "live" ? "page" : undefined} data-testid="nav-live">
        {t("nav.live")}
      </a>
    </>
  );
}

function Who({ account, onLogOut }: { account: Account; onLogOut: () => void }) {
  return (
    <>
      <span class="who">{account.name}</span>
      <button type="button" class="quiet" onClick={onLogOut} data-testid="log-out">
        {t("entry.log-out")}
      </button>
    </>
  );
}

export function LanguageSwitch() {
  return (
    <fieldset class="language" aria-label={t("language.label")}>
      {LANGUAGES.map(({ id, name }) => (
        <button
          key={id}
          type="button"
          lang={id}
          aria-pressed={language() === id}
          onClick={() => setLanguage(id)}
          data-testid={`language-${id}`}
        >
          {name}
        </button>
      ))}
    </fieldset>
  );
}
