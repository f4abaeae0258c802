import { describe, expect, test } from "vitest";
import { hrefOf, type Route, routeOf } from "./route";

const ROUTES: Route[] = [
  { page: "patients" },
  { page: "enrol" },
  { page: "patient", id: 3 },
  { page: "change-patient", id: 3 },
  { page: "prepare", id: 3 },
  { page: "plan", id: 3 },
  { page: "progress", id: 3 },
  { page: "scores", id: 3 },
  { page: "course-report", id: 3 },
  { page: "replay", id: 41 },
  { page: "session-report", id: 41 },
  { page: "live" },
  { page: "summary", id: 41 },
];

describe("the address", () => {
  test.each(ROUTES)("of page $page leads back to it", (route) => {
    expect(routeOf(hrefOf(route))).toEqual(route);
  });

  test.each(["", "#", "#/", "#/nowhere", "#/patients/abc", "#/sessions/1/2"])("%j is the list of patients", (hash) => {
    expect(routeOf(hash)).toEqual({ page: "patients" });
  });
});
