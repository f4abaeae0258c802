// A page that is fetched when somebody goes there, so that the first page needs no more than itself.
import type { ComponentType } from "preact";
import { useEffect, useState } from "preact/hooks";
import { t } from "../strings";

interface Props {
  load: () => Promise<ComponentType<{ id: number }>>;
  id: number;
}

export function Later({ load, id }: Props) {
  const [Page, setPage] = useState<ComponentType<{ id: number }> | null>(null);
  const [failed, setFailed] = useState(false);
  useEffect(() => {
    // `load` is a new function at every drawing; whose page it is does not change while this stands.
    load().then(
      (page) => setPage(() => page),
      () => setFailed(true),
    );
  }, []);
  if (Page) return <Page id={id} />;
  return (
    <main class="page">
      <p role={failed ? "alert" : "status"}>{t(failed ? "app.not-fetched" : "app.loading")}</p>
    </main>
  );
}
