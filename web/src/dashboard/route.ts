// Which page the address names. Pages are told apart behind the `#`, so the service needs to know of one only.

export type Route =
  | { page: "patients" }
  | { page: "enrol" }
  | { page: "patient"; id: number }
  | { page: "change-patient"; id: number }
  | { page: "prepare"; id: number }
  | { page: "plan"; id: number }
  | { page: "progress"; id: number }
  | { page: "scores"; id: number }
  | { page: "course-report"; id: number }
  | { page: "live" }
  | { page: "summary"; id: number }
  | { page: "replay"; id: number }
  | { page: "session-report"; id: number };

const NUMBERED: readonly [RegExp, (id: number) => Route][] = [
  [/^patients\/(\d+)$/, (id) => ({ page: "patient", id })],
  [/^patients\/(\d+)\/change$/, (id) => ({ page: "change-patient", id })],
  [/^patients\/(\d+)\/session$/, (id) => ({ page: "prepare", id })],
  [/^patients\/(\d+)\/plan$/, (id) => ({ page: "plan", id })],
  [/^patients\/(\d+)\/progress$/, (id) => ({ page: "progress", id })],
  [/^patients\/(\d+)\/scores$/, (id) => ({ page: "scores", id })],
  [/^patients\/(\d+)\/report$/, (id) => ({ page: "course-report", id })],
  [/^sessions\/(\d+)\/replay$/, (id) => ({ page: "replay", id })],
  [/^sessions\/(\d+)\/report$/, (id) => ({ page: "session-report", id })],
  [/^sessions\/(\d+)$/, (id) => ({ page: "summary", id })],
];

/** The page of an address such as `#/patients/3`; the list of patients where it names none. */
export function routeOf(hash: string): Route {
  const path = hash.replace(/^#?\/?/, "");
  if (path === "live") return { page: "live" };
  if (path === "patients/new") return { page: "enrol" };
  for (const [pattern, make] of NUMBERED) {
    const id = pattern.exec(path)?.[1];
    if (id !== undefined) return make(Number(id));
  }
  return { page: "patients" };
}

/** The address of a page. */
export function hrefOf(route: Route): string {
  switch (route.page) {
    case "patients":
      return "#/";
    case "enrol":
      return "#/patients/new";
    case "patient":
      return `#/patients/${route.id}`;
    case "change-patient":
      return `#/patients/${route.id}/change`;
    case "prepare":
      return `#/patients/${route.id}/session`;
    case "plan":
    case "progress":
    case "scores":
      return `#/patients/${route.id}/${route.page}`;
    case "course-report":
      return `#/patients/${route.id}/report`;
    case "replay":
      return `#/sessions/${route.id}/replay`;
    case "session-report":
      return `#/sessions/${route.id}/report`;
    case "live":
      return "#/live";
    case "summary":
      return `#/sessions/${route.id}`;
  }
}

export function go(route: Route): void {
  location.hash = hrefOf(route);
}
