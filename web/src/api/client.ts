// What the dashboard asks of the service, typed by its own description.
import createClient from "openapi-fetch";
import { t } from "../strings";
import { clientId } from "./client-id";
import type { paths } from "./schema";
import type {
  Action,
  Assistance,
  ErrorDetail,
  GameWish,
  PatientForm,
  PatientLimits,
  PlanForm,
  ReplayForm,
  ScoreForm,
  SessionOpen,
  SessionUpdate,
  View3dShown,
} from "./types";

/** A refusal or a failure, as something a person can read and act upon. */
export class Problem extends Error {
  constructor(
    readonly status: number,
    readonly detail: ErrorDetail,
  ) {
    super(detail.what);
  }
}

/** Nobody is logged in any more. */
export const NOT_LOGGED_IN = 401;
const NOT_FOUND = 404;
const NO_ANSWER = 0;

interface Reply<T> {
  data?: T;
  error?: unknown;
  response: Response;
}

const http = createClient<paths>({ baseUrl: "/" });
http.use({ onRequest: ({ request }) => request.headers.set("Mirrorlimb-Client", clientId()) });

async function taken<T>(asked: Promise<Reply<T>>): Promise<T> {
  const reply = await asked.catch(() => {
    throw new Problem(NO_ANSWER, noAnswer());
  });
  if (!reply.response.ok) throw new Problem(reply.response.status, detailOf(reply.error));
  return reply.data as T;
}

function noAnswer(): ErrorDetail {
  return { what: t("problem.offline"), expected: t("problem.offline.expected"), remedy: t("problem.offline.remedy") };
}

/** What is wrong, also where something other than the service (a proxy) has answered. */
export function detailOf(error: unknown): ErrorDetail {
  const detail = (error as { detail?: Partial<ErrorDetail> } | undefined)?.detail;
  if (typeof detail?.what === "string") {
    return { what: detail.what, expected: detail.expected ?? "", remedy: detail.remedy ?? "" };
  }
  return { what: t("problem.unreadable"), expected: "", remedy: t("problem.offline.remedy") };
}

export const readStatus = () => taken(http.GET("/api/status"));
export const setUp = (name: string, password: string) => taken(http.POST("/api/setup", { body: { name, password } }));
export const logIn = (name: string, password: string) => taken(http.POST("/api/login", { body: { name, password } }));
export const logOut = () => taken(http.POST("/api/logout"));
export const enterDemo = () => taken(http.POST("/api/demo"));

export const listPatients = () => taken(http.GET("/api/patients"));
export const readPatient = (id: number) =>
  taken(http.GET("/api/patients/{patient_id}", { params: { path: { patient_id: id } } }));
export const enrolPatient = (form: PatientForm) => taken(http.POST("/api/patients", { body: form }));
export const changePatient = (id: number, form: PatientForm) =>
  taken(http.PATCH("/api/patients/{patient_id}", { params: { path: { patient_id: id } }, body: form }));
export const readCautiousLimits = () => taken(http.GET("/api/patients/cautious-limits"));
export const confirmLimits = (id: number, seen: PatientLimits) =>
  taken(http.POST("/api/patients/{patient_id}/confirm-limits", { params: { path: { patient_id: id } }, body: seen }));
export const readHistory = (id: number) =>
  taken(http.GET("/api/patients/{patient_id}/sessions", { params: { path: { patient_id: id } } }));

/** The patient's plan; null while there is none. */
export const readPlan = (id: number) =>
  taken(http.GET("/api/patients/{patient_id}/plan", { params: { path: { patient_id: id } } })).catch(nullWhereNone);
export const putPlan = (id: number, form: PlanForm) =>
  taken(http.PUT("/api/patients/{patient_id}/plan", { ...patient(id), body: form }));
/** What was done of what was planned in the last `weeks` calendar weeks. */
export const readAdherence = (id: number, weeks: number) =>
  taken(http.GET("/api/patients/{patient_id}/adherence", { params: { path: { patient_id: id }, query: { weeks } } }));
/** How every figure went over the patient's sessions. */
export const readProgress = (id: number) => taken(http.GET("/api/patients/{patient_id}/progress", patient(id)));
/** What every measure means: formula, source, filter, and how far these sensors can be trusted for it. */
export const listMeasures = () => taken(http.GET("/api/metrics"));
/** The tests that a person scores, with what a change in them means. */
export const listScales = () => taken(http.GET("/api/scales"));
export const listScores = (id: number) => taken(http.GET("/api/patients/{patient_id}/scores", patient(id)));
export const addScore = (id: number, form: ScoreForm) =>
  taken(http.POST("/api/patients/{patient_id}/scores", { ...patient(id), body: form }));
export const removeScore = (id: number, number: number) =>
  taken(http.DELETE("/api/patients/{patient_id}/scores/{number}", { params: { path: { patient_id: id, number } } }));
export const readToday = () => taken(http.GET("/api/today"));
export const listGames = () => taken(http.GET("/api/games"));

export const openSession = (form: SessionOpen) => taken(http.POST("/api/sessions", { body: form }));
export const currentSession = () => taken(http.GET("/api/sessions/current"));
export const readSession = (id: number) => taken(http.GET("/api/sessions/{session_id}", session(id)));
export const changeSession = (id: number, form: SessionUpdate) =>
  taken(http.PATCH("/api/sessions/{session_id}", { ...session(id), body: form }));
export const readCurves = (id: number) => taken(http.GET("/api/sessions/{session_id}/curves", session(id)));
export const readEvents = (id: number) => taken(http.GET("/api/sessions/{session_id}/events", session(id)));
/** Asks for something of the arm; without an answer in `patience_ms` it counts as not answered. */
export const control = (id: number, action: Action, patience_ms?: number) =>
  taken(
    http.POST("/api/sessions/{session_id}/control", {
      ...session(id),
      body: { action },
      ...(patience_ms && { signal: AbortSignal.timeout(patience_ms) }),
    }),
  );
export const setAssistance = (id: number, mode: Assistance, level: number) =>
  taken(http.POST("/api/sessions/{session_id}/assistance", { ...session(id), body: { mode, level } }));
/** Takes over; while somebody else is there it is refused unless `confirmed`. */
export const takeAuthority = (id: number, confirmed: boolean) =>
  taken(http.POST("/api/sessions/{session_id}/authority", { ...session(id), body: { confirmed } }));
export const followBody = (id: number, sensor: string, body: string) =>
  taken(http.POST("/api/sessions/{session_id}/follow", { ...session(id), body: { sensor, body } }));
/** Wishes something of the game; `level` goes with `pin`. */
export const wishOfGame = (id: number, wish: GameWish, level: number | null = null) =>
  taken(http.POST("/api/sessions/{session_id}/game", { ...session(id), body: { wish, level } }));
export const readWorkspace = (id: number) => taken(http.GET("/api/sessions/{session_id}/workspace", session(id)));
/** The games go by what the healthy arm has shown. */
export const takeWorkspace = (id: number) => taken(http.POST("/api/sessions/{session_id}/workspace", session(id)));
export const endSession = (id: number, painAfter: number | null) =>
  taken(http.POST("/api/sessions/{session_id}/end", { ...session(id), body: { pain_after: painAfter } }));

export const readView3d = () => taken(http.GET("/api/view3d"));
export const showInView3d = (shown: View3dShown) => taken(http.PUT("/api/view3d", { body: shown }));

/** Shows a past session, or changes how it runs. */
export const playAgain = (form: ReplayForm) => taken(http.PUT("/api/replay", { body: form }));
export const readReplay = () => taken(http.GET("/api/replay"));
export const readTimeline = () => taken(http.GET("/api/replay/timeline"));

export const readStation = () => taken(http.GET("/api/station"));

function nullWhereNone(error: unknown): null {
  if (error instanceof Problem && error.status === NOT_FOUND) return null;
  throw error;
}

function patient(id: number) {
  return { params: { path: { patient_id: id } } };
}

function session(id: number) {
  return { params: { path: { session_id: id } } };
}
