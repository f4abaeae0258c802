// Numbers and dates as people read them: degrees, millimetres, milliseconds.
import { language } from "../strings";
import { said } from "../strings/said";

const DEGREES_PER_RAD = 180 / Math.PI;
const NOTHING = "–";

export function degrees(angleRad: number): number {
  return angleRad * DEGREES_PER_RAD;
}

export function radians(angleDeg: number): number {
  return angleDeg / DEGREES_PER_RAD;
}

/** A number with `digits` decimals, or a dash where there is none. */
export function figure(value: number | null | undefined, digits = 0): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return NOTHING;
  const text = value.toFixed(digits);
  return Number(text) === 0 ? (0).toFixed(digits) : text.replace("-", "−");
}

export function angleText(angleRad: number | null | undefined): string {
  return typeof angleRad === "number" && Number.isFinite(angleRad) ? `${figure(degrees(angleRad))}°` : NOTHING;
}

/** Thousandths, as milliseconds of seconds or millimetres of metres. */
export function thousandths(value: number | null | undefined): string {
  return typeof value === "number" ? figure(value * 1000) : NOTHING;
}

/** Minutes and seconds, `4:07`. */
export function duration(seconds: number): string {
  const whole = Math.max(0, Math.round(seconds));
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

export function secondsBetween(start: string | undefined, end: string | null | undefined): number | null {
  if (!start || !end) return null;
  return (Date.parse(end) - Date.parse(start)) / 1000;
}

export function dateAndTime(iso: string | undefined): string {
  if (!iso) return NOTHING;
  return new Date(iso).toLocaleString(locale(), { dateStyle: "medium", timeStyle: "short" });
}

/** A day, from a date without a time or from a moment. */
export function dateText(iso: string | undefined): string {
  return iso ? dayOf(iso).toLocaleDateString(locale(), { dateStyle: "medium" }) : NOTHING;
}

/** The day itself, at midnight here; a date without a time would else be taken for one in Greenwich. */
export function dayOf(iso: string): Date {
  if (iso.length > "2026-03-02".length) return new Date(iso);
  const [year = 0, month = 1, day = 1] = iso.split("-").map(Number);
  return new Date(year, month - 1, day);
}

/** A day as forms and the service write it, `2026-03-02`. */
export function isoDay(day: Date): string {
  const two = (value: number) => String(value).padStart(2, "0");
  return `${day.getFullYear()}-${two(day.getMonth() + 1)}-${two(day.getDate())}`;
}

export function clockTime(iso: string | undefined): string {
  if (!iso) return NOTHING;
  return new Date(iso).toLocaleTimeString(locale());
}

export function locale(): string {
  return language() === "zh" ? "zh-CN" : "en-GB";
}

/** Something the service said, in the language chosen and with a capital at its head. */
export function sentence(phrase: string): string {
  const words = said(phrase);
  return words.charAt(0).toUpperCase() + words.slice(1);
}
