// A patient's progress.
import { PatientTabs } from "../patient/tabs";

export function ProgressPage({ id }: { id: number }) {
  return (
    <main class="page" data-testid="progress">
      <PatientTabs id={id} at="progress" />
    </main>
  );
}
