// A sweep's flights: what varies, what each flight reached, and the shortest that is good enough.
import type { Suite, Sweep, TableRow } from "./data";

export type Value = number | string;

// A flight of the sweep with what it reached; metres, NaN where nothing was found.
export interface Flight {
  values: Value[]; // of the axes
  farms: number;
  plots: number;
  found: number;
  extra: number;
  rmse: number;
  low: number; // ends of its 95 % interval
  high: number;
  bias: number;
  within: number;
  seconds: number; // of the flight
  points: number; // of its scan
}

export interface Goal {
  rmse: number; // metres
  found: number; // share
}

const kUnits: [string, string][] = [["_m_s", "m/s"], ["_deg", "°"], ["_hz", "Hz"], ["_m", "m"], ["_s", "s"]];
const kNames: Record<string, string> = { spacing: "strip spacing" };

// "altitude_m" as people say it, and its unit.
export function axisName(key: string): { name: string; unit: string } {
  const [suffix, unit] = kUnits.find(([end]) => key.endsWith(end)) ?? ["", ""];
  const name = key.slice(0, key.length - suffix.length).replaceAll("_", " ");
  return { name: kNames[name] ?? name, unit };
}

// "altitude 20 m".
export function told(key: string, value: Value): string {
  const { name, unit } = axisName(key);
  return `${name} ${value}${unit ? ` ${unit}` : ""}`;
}

// The axes' values of combination i, the last axis varying fastest.
export function combination({ axes }: Sweep, i: number): Value[] {
  const values: Value[] = [];
  for (const { values: choices } of [...axes].reverse()) {
    values.unshift(choices[i % choices.length]);
    i = Math.floor(i / choices.length);
  }
  return values;
}

const number = (row: TableRow | undefined, key: string): number => (typeof row?.[key] === "number" ? (row[key] as number) : NaN);

// The flights as one method's height did on them, in the order of the cases.
export function flightsOf(suite: Suite, method: string, truth: string): Flight[] {
  const sweep = suite.sweep!;
  return suite.cases.map(({ name }, i) => {
    const row = suite.table.find((one) => one.case === name && one.method === method && one.truth === truth);
    return {
      values: combination(sweep, i), farms: number(row, "farms"), plots: number(row, "plots"), found: number(row, "found"),
      extra: number(row, "extra"), rmse: number(row, "rmse_m"), low: number(row, "rmse_low_m"), high: number(row, "rmse_high_m"),
      bias: number(row, "bias_m"), within: number(row, "within_m"), seconds: sweep.flights[i].flight_s ?? NaN, points: sweep.flights[i].points ?? NaN };
  });
}

// By the upper end of the RMSE's interval; of a single farm, which has none, by the RMSE.
export const reaches = (flight: Flight, goal: Goal): boolean =>
  (Number.isFinite(flight.high) ? flight.high : flight.rmse) <= goal.rmse && flight.found >= goal.found * flight.plots;

export function shortest(flights: Flight[], goal: Goal): Flight | undefined {
  return flights.filter((flight) => reaches(flight, goal)).reduce<Flight | undefined>(
    (best, flight) => (best && best.seconds <= flight.seconds ? best : flight), undefined);
}
