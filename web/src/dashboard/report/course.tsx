// The report of a whole course of therapy.
import { PatientTabs } from "../patient/tabs";

export function CourseReport({ id }: { id: number }) {
  return (
    <main class="page" data-testid="report">
      <PatientTabs id={id} at="course-report" />
    </main>
  );
}
