// Numbers with units, shares, times and typed numbers, as the language of the page writes them.
import { locale, t, written } from "./words";

/// A number with as many digits as people read at a glance.
export function number(value: number, step = 0): string {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  let digits = size >= 100 ? 0 : size >= 10 ? 1 : 2;
  if (step > 0) digits = Math.min(6, Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
  return written(value === 0 ? 0 : value, "decimal", digits);
}

/// A unit as people write it: scenes say `m2`.
export function unit_sign(unit: string): string {
  return unit === "1" ? "" : unit.replace(/m2\b/g, "m²").replace(/m3\b/g, "m³");
}

/// With its unit, kept together on one line.
export function amount(value: number, unit: string, step = 0): string {
  const sign = unit_sign(unit);
  return sign === "" ? number(value, step) : `${number(value, step)}\u00a0${sign}`;
}

export function share(value: number): string {
  return written(value, "percent", 0);
}

/// A length of time, such as "12 s" or "3 min".
export function duration(milliseconds: number): string {
  const seconds = Math.max(0, Math.floor(milliseconds / 1000));
  return seconds < 120 ? t("seconds", { n: seconds }) : t("minutes", { n: Math.floor(seconds / 60) });
}

/// The time of day, as the language writes it.
export function clock_time(at: number): string {
  return new Date(at).toLocaleTimeString(locale(), { hour: "2-digit", minute: "2-digit" });
}

/// What a timer shows, such as "4:07".
export function countdown(milliseconds: number): string {
  const seconds = Math.max(0, Math.ceil(milliseconds / 1000));
  return `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`;
}

/// A number as people type it: with the decimal sign and the groups of their language, or a plain one. Null where it is none.
export function typed_number(text: string): number | null {
  const parts = new Intl.NumberFormat(locale()).formatToParts(1234567.5);
  const decimal = parts.find((part) => part.type === "decimal")?.value ?? ".";
  const group = parts.find((part) => part.type === "group")?.value ?? ",";
  const clean = text.trim().replace(/[\s\u00a0\u202f']/g, "");
  if (clean === "") return null;
  const grouped = new RegExp(`^[-+]?\\d{1,3}(\\${group}\\d{3})+(\\${decimal}\\d*)?$`);
  const plain = grouped.test(clean) ? clean.split(group).join("") : clean;
  const normal = decimal === "." ? plain : plain.replace(decimal, ".");
  return /^[-+]?(\d+\.?\d*|\.\d+)$/.test(normal) ? Number(normal) : null;
}

/// The nearest value that a control can have.
export function in_steps(value: number, minimum: number, maximum: number, step: number): number {
  const bounded = Math.min(maximum, Math.max(minimum, value));
  if (!(step > 0)) return bounded;
  const stepped = minimum + Math.round((bounded - minimum) / step) * step;
  return Math.min(maximum, Number(stepped.toPrecision(12)));
}

/// A round step for a range that comes without one: about a hundred of them fit.
export function round_step(least: number, most: number): number {
  const span = most - least;
  if (!(span > 0)) return 1;
  const power = Math.pow(10, Math.floor(Math.log10(span / 100)));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((one) => span / one <= 100) ?? power;
  return Number(step.toPrecision(6));
}
