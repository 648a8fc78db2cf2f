// The heights of a page: their order, and the colour that each has in all figures, and in plotview's pictures
// (viewer/view/internal/height_lines.cpp).
import type { Field, Plot } from "./data";

// Which of the theme's kinds; none of the common ones is the crop's or the true ground's.
const kKinds = new Map([["max", 0], ["p99", 4], ["p95", 3], ["p90", 6], ["p50", 7], ["mean", 1], ["canopy_p99", 2], ["canopy_p95", 5]]);
const kFree = [0, 1, 3, 4, 6, 7, 2, 5]; // of other names, the best first

// The heights that any plot of the field has.
export function heightNames(field: Field): string[] {
  const names = new Set(field.plots.flatMap((plot) => Object.keys(plot.heights)));
  const order = [...kKinds.keys()];
  return [...names].sort((a, b) => (order.indexOf(a) + 1 || 99) - (order.indexOf(b) + 1 || 99) || a.localeCompare(b));
}

// The one that a page opens with: that which docs/reading-results.md recommends, else the first.
export const firstHeight = (names: string[]): string => (names.includes("canopy_p95") ? "canopy_p95" : names[0] ?? "");

// Flags of one height end so (estimator/heights/flags.cpp).
const kUnsure = " height is unsure by centimetres";

// The flags of a plot that concern this height; without one, those of the plot as a whole.
export const flagsOf = (plot: Plot, height = ""): string[] =>
  plot.flags.filter((flag) => !flag.endsWith(kUnsure) || flag === height + kUnsure);

// All flags of a plot as sentences: those of single heights in one.
export function flagLines(plot: Plot): string[] {
  const unsure = plot.flags.filter((flag) => flag.endsWith(kUnsure)).map((flag) => flag.slice(0, -kUnsure.length));
  return [...flagsOf(plot), ...(unsure.length ? [`unsure by centimetres: ${unsure.join(", ")}`] : [])];
}

// The colours of all heights of a field, whichever are shown.
export function heightKinds(field: Field): Map<string, number> {
  const names = heightNames(field);
  const taken = names.map((name) => kKinds.get(name));
  const free = [...kFree.filter((kind) => !taken.includes(kind)), ...kFree];
  let next = 0;
  return new Map(names.map((name) => [name, kKinds.get(name) ?? free[next++ % free.length]]));
}

// Colours of those that are chosen out of many: what was chosen before keeps its colour.
export function keptKinds(before: Map<string, number>, chosen: string[]): Map<string, number> {
  const kept = new Map([...before].filter(([name]) => chosen.includes(name)));
  const free = chosen.map((_, kind) => kind).filter((kind) => ![...kept.values()].includes(kind));
  for (const name of chosen) if (!kept.has(name)) kept.set(name, free.shift()!);
  return kept;
}
