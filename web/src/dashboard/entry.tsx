// How one comes in: the first account, the log-in, the demonstration.
import type { ComponentChildren } from "preact";
import { useState } from "preact/hooks";
import { enterDemo, logIn, setUp } from "../api/client";
import { t } from "../strings";
import { type Doing, useDoing } from "./hooks";
import { ProblemBox } from "./problem";
import { go } from "./route";

/** The service refuses shorter ones (`NewCredentials`). */
const SHORTEST_PASSWORD = 10;

interface Props {
  demo: boolean;
  onEntered: () => void;
}

export function LogIn({ demo, onEntered }: Props) {
  const doing = useDoing();
  return (
    <EntryPage title={t("entry.title")} demo={demo} doing={doing} onEntered={onEntered}>
      <Credentials
        doing={doing}
        button={t("entry.log-in")}
        shortest={1}
        autoComplete="current-password"
        onSend={(name, password) => logIn(name, password).then(onEntered)}
      />
    </EntryPage>
  );
}

export function FirstStart({ demo, onEntered }: Props) {
  const doing = useDoing();
  return (
    <EntryPage title={t("entry.first.title")} demo={demo} doing={doing} onEntered={onEntered}>
      <p>{t("entry.first.why")}</p>
      <Credentials
        doing={doing}
        button={t("entry.first.create")}
        shortest={SHORTEST_PASSWORD}
        autoComplete="new-password"
        onSend={(name, password) => setUp(name, password).then(onEntered)}
      />
    </EntryPage>
  );
}

interface EntryPageProps extends Props {
  title: string;
  doing: Doing;
  children: ComponentChildren;
}

function EntryPage({ title, demo, doing, onEntered, children }: EntryPageProps) {
  return (
    <main class="page page-narrow">
      {demo && <DemoCard doing={doing} onEntered={onEntered} />}
      <section class="card">
        <h1>{title}</h1>
        <ProblemBox problem={doing.problem} onClose={doing.forget} />
        {children}
      </section>
    </main>
  );
}

function DemoCard({ doing, onEntered }: { doing: Doing; onEntered: () => void }) {
  const enter = () =>
    doing.run(async () => {
      const { patient } = await enterDemo();
      go({ page: "patient", id: patient.id });
      onEntered();
    });
  return (
    <section class="card">
      <p>{t("entry.demo.what")}</p>
      <button type="button" class="primary big" disabled={doing.busy} onClick={enter} data-testid="login-demo">
        {t("entry.demo")}
      </button>
    </section>
  );
}

interface CredentialsProps {
  doing: Doing;
  button: string;
  shortest: number;
  autoComplete: "current-password" | "new-password";
  onSend: (name: string, password: string) => Promise<void>;
}

function Credentials({ doing, button, shortest, autoComplete, onSend }: CredentialsProps) {
  const [name, setName] = useState("");
  const [password, setPassword] = useState("");
  const send = (event: Event) => {
    event.preventDefault();
    doing.run(() => onSend(name, password));
  };
  return (
    <form class="card-form" onSubmit={send}>
      <label>
        {t("entry.name")}
        <input
          required
          maxLength={80}
          autoComplete="username"
          value={name}
          onInput={(event) => setName(event.currentTarget.value)}
          data-testid="account-name"
        />
      </label>
      <label>
        {t("entry.password")}
        {shortest > 1 && <span class="hint">{t("entry.password.hint", { shortest })}</span>}
        <input
          required
          type="password"
          minLength={shortest}
          maxLength={200}
          autoComplete={autoComplete}
          value={password}
          onInput={(event) => setPassword(event.currentTarget.value)}
          data-testid="account-password"
        />
      </label>
      <button class="primary" type="submit" disabled={doing.busy} data-testid="log-in">
        {button}
      </button>
    </form>
  );
}
