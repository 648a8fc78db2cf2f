// Numbers as people read them.

export function fixed(value: number | null | undefined, digits: number): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  return (Number(text) === 0 ? text.replace("-", "") : text).replace("-", "−");
}

export function signed(value: number | null | undefined, digits: number): string {
  const text = fixed(value, digits);
  return value !== null && value !== undefined && Number(value.toFixed(digits)) > 0 ? "+" + text : text;
}

export const counted = (n: number): string => n.toLocaleString("en-GB").replaceAll(",", " ");

// "height_max_m" as people say it.
export function truthName(attribute: string): string {
  const names: Record<string, string> = {
    height_max_m: "tallest plant", height_mean_m: "mean plant height",
    height_p50_m: "median plant", height_p90_m: "90th percentile of the plants",
    height_p95_m: "95th percentile of the plants", height_p99_m: "99th percentile of the plants",
    height_hand3_m: "mean of three plants by hand",
    canopy_p95_m: "95th percentile of the canopy", canopy_p99_m: "99th percentile of the canopy",
  };
  return names[attribute] ?? attribute.replace(/_m$/, "").replaceAll("_", " ");
}

// The truth that a height claims to be by its name.
export const namedTruth = (height: string): string =>
  height.startsWith("canopy_") ? `${height}_m` : `height_${height}_m`;

// Round numbers from low to high, about `count` of them.
export function ticks(low: number, high: number, count = 5): number[] {
  const span = high - low;
  if (!(span > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(span / count));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((size) => span / size <= count + 0.5) ?? 10 * power;
  const values: number[] = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * span; ++i)
    values.push(Number((i * step).toPrecision(12)));
  return values;
}

// The least and the largest number, `otherwise` where there is none. Math.min(...values) fails on some 120,000 of them.
export function extremes(values: number[], otherwise: [number, number]): [number, number] {
  if (values.length === 0) return otherwise;
  return values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [values[0], values[0]]);
}

export function quantile(sorted: ArrayLike<number>, share: number): number {
  if (sorted.length === 0) return NaN;
  const at = share * (sorted.length - 1);
  const i = Math.floor(at);
  const next = Math.min(i + 1, sorted.length - 1);
  return sorted[i] + (at - i) * (sorted[next] - sorted[i]);
}

// RFC 4180; numbers to six decimals, which is a micrometre.
export function csv(rows: (string | number | null | undefined)[][]): string {
  const cell = (value: string | number | null | undefined): string => {
    if (value === null || value === undefined || (typeof value === "number" && !Number.isFinite(value))) return "";
    const text = String(typeof value === "number" ? Number(value.toFixed(6)) : value);
    return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  return rows.map((row) => row.map(cell).join(",") + "\r\n").join("");
}
