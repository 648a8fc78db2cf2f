// Scores of estimates against truths, as docs/benchmark.md defines them. Errors are estimate minus truth.

export interface Pair {
  estimate: number;
  truth: number;
  farm: number; // which field it lies on
  label: string;
}

const sum = (values: number[]): number => values.reduce((all, value) => all + value, 0);
export const mean = (values: number[]): number => sum(values) / values.length;
const rms = (values: number[]): number => Math.sqrt(mean(values.map((value) => value * value)));
export const error = (pair: Pair): number => pair.estimate - pair.truth;

export const rmse = (pairs: Pair[]): number => rms(pairs.map(error));
export const bias = (pairs: Pair[]): number => mean(pairs.map(error));

// 1 - SSE / SST against the line estimate = truth.
export function r2(pairs: Pair[]): number {
  const middle = mean(pairs.map((pair) => pair.truth));
  const spread = sum(pairs.map((pair) => (pair.truth - middle) ** 2));
  return spread > 0 ? 1 - sum(pairs.map((pair) => error(pair) ** 2)) / spread : NaN;
}

export function byFarm(pairs: Pair[]): Pair[][] {
  const farms = new Map<number, Pair[]>();
  for (const pair of pairs) {
    if (!farms.has(pair.farm)) farms.set(pair.farm, []);
    farms.get(pair.farm)!.push(pair);
  }
  return [...farms.values()];
}

// Of the errors less their farm's mean error.
export function within(pairs: Pair[]): number {
  return rms(byFarm(pairs).flatMap((farm) => farm.map((pair) => error(pair) - bias(farm))));
}

// Square of Pearson's correlation of estimates and truths, each less its farm's mean.
export function r2Within(pairs: Pair[]): number {
  let both = 0;
  let estimates = 0;
  let truths = 0;
  for (const farm of byFarm(pairs)) {
    const estimate = mean(farm.map((pair) => pair.estimate));
    const truth = mean(farm.map((pair) => pair.truth));
    for (const pair of farm) {
      both += (pair.estimate - estimate) * (pair.truth - truth);
      estimates += (pair.estimate - estimate) ** 2;
      truths += (pair.truth - truth) ** 2;
    }
  }
  return estimates > 0 && truths > 0 ? both ** 2 / (estimates * truths) : NaN;
}

// The error of saying each field's mean truth for all of its plots: the best single number for a field.
export function oneNumber(pairs: Pair[]): number {
  return within(pairs.map((pair) => ({ ...pair, estimate: 0 })));
}

const kMostGroups = 50;

// Standard error of a statistic by the jackknife, a farm left out at a time, of a single farm a plot at a
// time (Efron and Tibshirani 1993, chapter 11). More than 50 are left out in 50 groups.
export function standardError(pairs: Pair[], statistic: (pairs: Pair[]) => number): number {
  const farms = byFarm(pairs);
  const single = farms.length > 1 ? farms : pairs.map((pair) => [pair]);
  if (single.length < 2) return NaN;
  const units: Pair[][] = Array.from({ length: Math.min(single.length, kMostGroups) }, () => []);
  single.forEach((unit, i) => unit.forEach((pair) => units[i % units.length].push(pair)));
  const left = units.map((_, i) => statistic(units.filter((__, k) => k !== i).flat()));
  const middle = mean(left);
  return Math.sqrt(((units.length - 1) / units.length) * sum(left.map((value) => (value - middle) ** 2)));
}

export interface Bin {
  low: number; // of the error as a share of the truth
  share: number; // of all pairs
  count: number;
}

// Relative errors in bins of `width` whose edges are its multiples.
export function relativeErrors(pairs: Pair[], width = 0.05): Bin[] {
  const counts = new Map<number, number>();
  for (const pair of pairs) {
    if (!(pair.truth > 0)) continue;
    const bin = Math.floor(error(pair) / pair.truth / width + 1e-9);
    counts.set(bin, (counts.get(bin) ?? 0) + 1);
  }
  const all = sum([...counts.values()]);
  return [...counts.keys()].sort((a, b) => a - b).map((bin) =>
    ({ low: bin * width, share: counts.get(bin)! / all, count: counts.get(bin)! }));
}
