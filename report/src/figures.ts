// The figures of heights against truths: the paper's, and what it lacks.
import { canvas, frame, legend, line, mark, text, type Panel } from "./axes";
import type { Theme } from "./colours";
import { s } from "./dom";
import { counted, csv, fixed, signed } from "./numbers";
import { bias, error, oneNumber, r2, r2Within, relativeErrors, rmse, rmseStandardError, within, type Pair } from "./statistics";

// One method's height on one kind of field.
export interface Group {
  name: string; // of the case
  pairs: Pair[];
}
export interface Method {
  name: string;
  groups: Group[]; // as many as there are cases, in their order
}

export interface Bar {
  group: string;
  method: string;
  value: number; // metres, as all here
  low: number;
  high: number;
  n: number;
}

const panels = (count: number, width: number, top: number, height: number): Panel[] => {
  const gap = 46;
  const each = (width - gap - 8 - (count - 1) * gap) / count;
  return Array.from({ length: count }, (_, i) => ({ left: gap + i * (each + gap), top, width: each, height }));
};

const widthFor = (count: number): number => (count === 1 ? 360 : Math.min(1100, 300 * count));
const colourOf = (theme: Theme, i: number): string => theme.kinds[i % theme.kinds.length];
const names = (methods: Method[], theme: Theme) =>
  methods.map((method, i) => ({ name: method.name, colour: colourOf(theme, i), shape: i }));

// The height of a legend before it is drawn.
function legendHeight(methods: { name: string }[], width: number): number {
  let lines = 1;
  let x = 0;
  for (const { name } of methods) {
    const size = 26 + 6.1 * name.length;
    if (x > 0 && x + size - 6 > width) {
      ++lines;
      x = 0;
    }
    x += size;
  }
  return 15 * lines + 6;
}

// Bars of a method beside each other in each case, with their error bars; a dashed line where a figure was published.
export function drawBars(
  title: string, label: string, bars: Bar[], theme: Theme, published: Record<string, number | undefined> = {},
  references: Record<string, number> = {}): SVGSVGElement {
  const groups = [...new Set(bars.map((bar) => bar.group))];
  const methods = [...new Set(bars.map((bar) => bar.method))];
  const width = Math.max(360, Math.min(1100, 90 + groups.length * (26 * methods.length + 34)));
  const legendNames = methods.map((name, i) => ({ name, colour: colourOf(theme, i), shape: 1 }));
  const extra: Parameters<typeof legend>[1] = [];
  if (Object.values(published).some((value) => value !== undefined)) extra.push({ name: "published", colour: theme.ink, dash: "6 3" });
  if (Object.keys(references).length) extra.push({ name: "one number for each field", colour: theme.ink, dash: "2 2" });
  const top = 8 + legendHeight([...legendNames, ...extra], width - 54);
  const svg = canvas(width, top + 258, theme, title);
  legend(svg, [...legendNames, ...extra], 46, 16, width - 54);
  const panel = { left: 46, top, width: width - 54, height: 200 };
  const highest = Math.max(
    0.01, ...bars.flatMap((bar) => [bar.value, bar.high]).filter(Number.isFinite), ...Object.values(references),
    ...Object.values(published).map((value) => value ?? 0));
  const { y, group } = frame(svg, panel, { low: 0, high: groups.length, label: "", labels: [] },
    { low: 0, high: 105 * highest, label }, theme);
  groups.forEach((name, i) => {
    const each = panel.width / groups.length;
    const left = panel.left + each * i;
    const size = Math.min(30, (0.84 * each) / methods.length);
    const first = left + (each - size * methods.length) / 2;
    methods.forEach((method, k) => {
      const bar = bars.find((candidate) => candidate.group === name && candidate.method === method);
      if (!bar || !Number.isFinite(bar.value)) return;
      const x = first + size * k;
      const words = `${method}, ${name}: ${fixed(100 * bar.value, 2)} [${fixed(100 * bar.low, 2)}, ${fixed(100 * bar.high, 2)}] cm, n = ${bar.n}`;
      group.append(s("rect", { x: x + 1.5, y: y(100 * bar.value), width: size - 3, height: y(0) - y(100 * bar.value), fill: colourOf(theme, k) }, s("title", {}, words)));
      const middle = x + size / 2;
      if (Number.isFinite(bar.low) && Number.isFinite(bar.high))
        group.append(line(middle, y(100 * bar.low), middle, y(100 * bar.high), theme.ink, 1.3),
          ...[bar.low, bar.high].map((end) => line(middle - 3, y(100 * end), middle + 3, y(100 * end), theme.ink, 1.3)));
    });
    for (const [value, dash] of [[published[name], "6 3"], [references[name], "2 2"]] as const)
      if (value !== undefined) group.append(line(left + 0.04 * each, y(100 * value), left + 0.96 * each, y(100 * value), theme.ink, 1.6, dash));
    const n = Math.max(0, ...bars.filter((bar) => bar.group === name).map((bar) => bar.n));
    svg.append(text(left + each / 2, panel.top + panel.height + 15, name, { anchor: "middle" }),
      text(left + each / 2, panel.top + panel.height + 30, `n = ${counted(n)}`, { anchor: "middle", colour: theme.soft }));
  });
  return svg;
}

export const barsCsv = (bars: Bar[], value: string): string => csv([
  ["case", "method", `${value}_cm`, "low_cm", "high_cm", "n"],
  ...bars.map((bar) => [bar.group, bar.method, 100 * bar.value, 100 * bar.low, 100 * bar.high, bar.n]),
]);

// RMSE with its standard error.
export function standardErrorBars(methods: Method[]): Bar[] {
  return methods.flatMap((method) => method.groups.filter((group) => group.pairs.length > 0).map((group) => {
    const value = rmse(group.pairs);
    const se = rmseStandardError(group.pairs);
    return { group: group.name, method: method.name, value, low: value - se, high: value + se, n: group.pairs.length };
  }));
}

export function withinBars(methods: Method[]): Bar[] {
  return methods.flatMap((method) => method.groups.filter((group) => group.pairs.length > 0).map((group) =>
    ({ group: group.name, method: method.name, value: within(group.pairs), low: NaN, high: NaN, n: group.pairs.length })));
}

// What the best single number for each field errs by, a case at a time.
export function references(methods: Method[]): Record<string, number> {
  const found: Record<string, number> = {};
  for (const { groups } of methods)
    for (const group of groups)
      if (group.pairs.length > 0 && !(group.name in found)) found[group.name] = oneNumber(group.pairs);
  return found;
}

// How often errors of so many per cent come, a panel a case.
export function drawHistograms(methods: Method[], theme: Theme): SVGSVGElement {
  const cases = methods[0]?.groups.map((group) => group.name) ?? [];
  const width = widthFor(cases.length);
  const top = 22 + legendHeight(methods, width - 54);
  const svg = canvas(width, top + 222, theme, "Relative errors in bins of 5 %");
  legend(svg, names(methods, theme).map((entry) => ({ ...entry, shape: 1 })), 46, 16, width - 54);
  const all = methods.map((method) => method.groups.map((group) => relativeErrors(group.pairs)));
  const bins = all.flat(2);
  const reach = Math.min(0.6, Math.max(0.1, ...bins.flatMap((bin) => [-bin.low, bin.low + 0.05])));
  const most = Math.max(0.1, ...bins.map((bin) => bin.share));
  panels(cases.length, width, top, 170).forEach((panel, i) => {
    svg.append(text(panel.left + panel.width / 2, top - 6, `${cases[i]}, n = ${Math.max(...methods.map((method) => method.groups[i].pairs.length))}`, { anchor: "middle" }));
    const { x, y, group } = frame(svg, panel,
      { low: -100 * reach, high: 100 * reach, label: "error, % of the truth", count: 5 },
      { low: 0, high: Math.min(104, 105 * most), label: i === 0 ? "share of plots, %" : "" }, theme);
    group.append(line(x(0), panel.top, x(0), panel.top + panel.height, theme.soft));
    methods.forEach((method, k) => {
      const steps = Math.round((2 * reach) / 0.05);
      let d = `M${x(-100 * reach)} ${y(0)}`;
      for (let step = 0; step < steps; ++step) {
        const low = -reach + 0.05 * step;
        const bin = all[k][i].find((candidate) => Math.abs(candidate.low - low) < 1e-6);
        const level = y(100 * (bin?.share ?? 0));
        d += `V${level.toFixed(1)}H${x(100 * (low + 0.05)).toFixed(1)}`;
      }
      d += `V${y(0)}`;
      group.append(s("path", { d, fill: colourOf(theme, k), "fill-opacity": 0.16, stroke: colourOf(theme, k), "stroke-width": 1.7 }, s("title", {}, `${method.name}, ${cases[i]}`)));
    });
  });
  return svg;
}

export const histogramsCsv = (methods: Method[]): string => csv([
  ["case", "method", "error_from_percent", "error_to_percent", "plots", "share"],
  ...methods.flatMap((method) => method.groups.flatMap((group) => relativeErrors(group.pairs).map((bin) =>
    [group.name, method.name, Math.round(100 * bin.low), Math.round(100 * bin.low) + 5, bin.count, bin.share]))),
]);

// Estimated against true heights, a panel a case.
export function drawScatter(methods: Method[], theme: Theme): SVGSVGElement {
  const cases = methods[0]?.groups.map((group) => group.name) ?? [];
  const width = widthFor(cases.length);
  const lines = 13 * methods.length;
  const top = 22 + legendHeight(methods, width - 54);
  const places = panels(cases.length, width, top, 0);
  const side = places[0]?.width ?? 200;
  const svg = canvas(width, top + side + 46 + lines, theme, "Estimated against true heights");
  legend(svg, names(methods, theme), 46, 16, width - 54);
  const values = methods.flatMap((method) => method.groups.flatMap((group) => group.pairs.flatMap((pair) => [pair.estimate, pair.truth])));
  const low = values.length ? Math.min(...values) : 0;
  const high = values.length ? Math.max(...values) : 1;
  const margin = 0.04 * (high - low || 1);
  places.forEach((place, i) => {
    const panel = { ...place, height: side };
    svg.append(text(panel.left + panel.width / 2, top - 6, cases[i], { anchor: "middle" }));
    const { x, y, group } = frame(svg, panel,
      { low: low - margin, high: high + margin, label: "true height, m" },
      { low: low - margin, high: high + margin, label: i === 0 ? "estimated height, m" : "" }, theme);
    group.append(line(x(low - margin), y(low - margin), x(high + margin), y(high + margin), theme.soft, 1.2));
    methods.forEach((method, k) => {
      const { pairs } = method.groups[i];
      for (const pair of pairs) {
        const dot = mark(k, x(pair.truth), y(pair.estimate), 2.3, colourOf(theme, k), 0.6);
        dot.append(s("title", {}, `${pair.label}: ${fixed(pair.estimate, 3)} m, truth ${fixed(pair.truth, 3)} m (${method.name})`));
        group.append(dot);
      }
      const words = pairs.length === 0 ? "no plots found"
        : `R² ${fixed(r2(pairs), 2)} (within ${fixed(r2Within(pairs), 2)}), RMSE ${fixed(100 * rmse(pairs), 1)} cm, bias ${signed(100 * bias(pairs), 1)}, n ${pairs.length}`;
      svg.append(mark(k, panel.left - 2, panel.top + side + 40 + 13 * k, 3, colourOf(theme, k)),
        text(panel.left + 5, panel.top + side + 44 + 13 * k, words, { size: 9.5, colour: theme.soft }));
    });
  });
  return svg;
}

export const pairsCsv = (methods: Method[]): string => csv([
  ["case", "method", "plot", "estimate_m", "truth_m", "error_m"],
  ...methods.flatMap((method) => method.groups.flatMap((group) => group.pairs.map((pair) =>
    [group.name, method.name, pair.label, pair.estimate, pair.truth, Math.round(1e5 * error(pair)) / 1e5]))),
]);
