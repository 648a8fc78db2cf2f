// The figures of heights against truths: the paper's, and what it lacks.
import { canvas, frame, legend, legendHeight, line, mark, round, text, type LegendEntry, type Panel, type Scale } from "./axes";
import type { Theme } from "./colours";
import { s } from "./dom";
import { counted, csv, extremes, fixed, quantile } from "./numbers";
import { error, oneNumber, r2, r2Within, relativeErrors, rmse, standardError, within, type Pair } from "./statistics";

// One method's height on one kind of field.
export interface Group {
  name: string; // of the case
  pairs: Pair[];
}
export interface Method {
  name: string;
  kind: number; // of its colour and shape
  groups: Group[]; // as many as there are cases, in their order
}

export interface Bar {
  group: string;
  method: string;
  kind: number;
  value: number; // metres, as all here
  low: number;
  high: number;
  n: number;
}

// Panels side by side, `columns` of them in a row, each `pitch` pixels below the last row.
function panels(count: number, columns: number, width: number, top: number, height: number, pitch: number): Panel[] {
  const gap = 46;
  const each = (width - 8) / columns - gap;
  return Array.from({ length: count }, (_, i) => ({
    left: gap + (i % columns) * (each + gap), top: top + pitch * Math.floor(i / columns), width: each, height }));
}

const names = (methods: Method[], theme: Theme): LegendEntry[] =>
  methods.map(({ name, kind }) => ({ name, colour: theme.kinds[kind], shape: kind }));

// Lines over the bars of a case, metres.
export interface Lines {
  published?: Record<string, number>;
  references?: Record<string, number>;
}

// Bars of a method beside each other in each case, with their error bars; a dashed line where a figure was published.
export function drawBars(
  title: string, label: string, bars: Bar[], theme: Theme, narrow: boolean, lines: Lines = {}): SVGSVGElement {
  const groups = [...new Set(bars.map((bar) => bar.group))];
  const methods = [...new Set(bars.map((bar) => bar.method))];
  const colourOf = (method: string): string => theme.kinds[bars.find((bar) => bar.method === method)!.kind];
  const width = Math.max(360, Math.min(narrow ? 360 : 1100, 90 + groups.length * (26 * methods.length + 34)));
  const entries: LegendEntry[] = methods.map((name) => ({ name, colour: colourOf(name), shape: 1 }));
  const published = Object.values(lines.published ?? {});
  if (published.length) entries.push({ name: "published", colour: theme.ink, dash: "6 3" });
  if (Object.keys(lines.references ?? {}).length) entries.push({ name: "one number for each field", colour: theme.ink, dash: "2 2" });
  const top = 8 + legendHeight(entries, width - 54);
  const svg = canvas(width, top + 258, theme, title);
  legend(svg, entries, 46, 16, width - 54);
  const panel = { left: 46, top, width: width - 54, height: 200 };
  const values = bars.flatMap((bar) => [bar.value, bar.low, bar.high]).filter(Number.isFinite);
  const highest = Math.max(0.01, ...values, ...Object.values(lines.references ?? {}), ...published);
  const { y, group } = frame(svg, panel, { low: 0, high: groups.length, label: "", labels: [] },
    { low: 105 * Math.min(0, ...values), high: 105 * highest, label }, theme);
  groups.forEach((name, i) => {
    const each = panel.width / groups.length;
    const left = panel.left + each * i;
    const own = bars.filter((bar) => bar.group === name);
    const size = Math.min(30, (0.84 * each) / methods.length);
    own.forEach((bar) => {
      const k = methods.indexOf(bar.method);
      drawBar(group, bar, { x: left + (each - size * methods.length) / 2 + size * k, size, y, colour: colourOf(bar.method), ink: theme.ink });
    });
    for (const [value, dash] of [[lines.published?.[name], "6 3"], [lines.references?.[name], "2 2"]] as const)
      if (value !== undefined) group.append(line(left + 0.04 * each, y(100 * value), left + 0.96 * each, y(100 * value), theme.ink, 1.6, dash));
    const below = panel.top + panel.height;
    svg.append(text(left + each / 2, below + 15, name, { anchor: "middle" }),
      text(left + each / 2, below + 30, `n = ${counted(Math.max(0, ...own.map((bar) => bar.n)))}`, { anchor: "middle", colour: theme.soft }));
  });
  return svg;
}

function drawBar(
  group: SVGGElement, bar: Bar, { x, size, y, colour, ink }: { x: number; size: number; y: Scale; colour: string; ink: string }): void {
  if (!Number.isFinite(bar.value)) return;
  const cm = (metres: number) => fixed(100 * metres, 2);
  const words = `${bar.method}, ${bar.group}: ${cm(bar.value)} [${cm(bar.low)}, ${cm(bar.high)}] cm, n = ${bar.n}`;
  group.append(s("rect", {
    x: round(x + 1.5), y: round(y(Math.max(100 * bar.value, 0))), width: round(size - 3), height: round(Math.abs(y(0) - y(100 * bar.value))), fill: colour,
  }, s("title", {}, words)));
  if (!Number.isFinite(bar.low) || !Number.isFinite(bar.high)) return;
  const middle = x + size / 2;
  group.append(line(middle, y(100 * bar.low), middle, y(100 * bar.high), ink, 1.3),
    ...[bar.low, bar.high].map((end) => line(middle - 3, y(100 * end), middle + 3, y(100 * end), ink, 1.3)));
}

// Whether any bar has its error bar.
export const haveEnds = (bars: Bar[]): boolean => bars.some(({ low, high }) => Number.isFinite(low) && Number.isFinite(high));

export const barsCsv = (bars: Bar[], value: string): string => csv([
  ["case", "method", `${value}_cm`, "low_cm", "high_cm", "n"],
  ...bars.map((bar) => [bar.group, bar.method, 100 * bar.value, 100 * bar.low, 100 * bar.high, bar.n]),
]);

// A statistic of each method and case with its standard error.
function errorBars(methods: Method[], statistic: (pairs: Pair[]) => number): Bar[] {
  return methods.flatMap((method) => method.groups.filter((group) => group.pairs.length > 0).map((group) => {
    const value = statistic(group.pairs);
    const se = standardError(group.pairs, statistic);
    return { group: group.name, method: method.name, kind: method.kind, value, low: value - se, high: value + se, n: group.pairs.length };
  }));
}

export const rmseBars = (methods: Method[]): Bar[] => errorBars(methods, rmse);
export const withinBars = (methods: Method[]): Bar[] => errorBars(methods, within);

// What the best single number for each field errs by, a case at a time.
export function references(methods: Method[]): Record<string, number> {
  const found: Record<string, number> = {};
  for (const { groups } of methods)
    for (const group of groups)
      if (group.pairs.length > 0 && !(group.name in found)) found[group.name] = oneNumber(group.pairs);
  return found;
}

// How often errors of so many per cent come: a row of panels a case, a column a method.
export function drawHistograms(methods: Method[], theme: Theme): SVGSVGElement {
  const cases = methods[0]?.groups.map((group) => group.name) ?? [];
  const columns = Math.max(methods.length, 1);
  const width = Math.max(360, Math.min(1100, 216 * columns + 54));
  const top = 20 + legendHeight(methods, width - 54);
  const svg = canvas(width, top + 128 * cases.length + 8, theme, "Relative errors in bins of 5 %");
  legend(svg, names(methods, theme).map((entry) => ({ ...entry, shape: 1 })), 46, 16, width - 54);
  const all = methods.map((method) => method.groups.map((group) => relativeErrors(group.pairs)));
  const common = all.flat(2).filter((bin) => bin.share >= 0.01);
  const reach = Math.min(0.4, Math.max(0.15, ...common.flatMap((bin) => [-bin.low, bin.low + 0.05])));
  const outside = (bin: { low: number }) => bin.low < -reach - 1e-9 || bin.low + 0.05 > reach + 1e-9;
  const most = Math.max(0.1, ...all.flat(2).map((bin) => bin.share));
  const places = panels(columns * cases.length, columns, width, top, 100, 128);
  svg.append(text(width / 2 + 19, top + 1 + 128 * cases.length, "error, % of the truth", { anchor: "middle" }));
  methods.forEach((method, k) => {
    method.groups.forEach(({ name, pairs }, i) => {
      const panel = places[columns * i + k];
      const last = i === cases.length - 1;
      const { x, y, group } = frame(svg, panel,
        { low: -100 * reach, high: 100 * reach, label: "", count: 5, labels: last ? undefined : [] },
        { low: 0, high: Math.min(104, 105 * most), label: k === 0 ? "plots, %" : "", count: 3 }, theme);
      for (const bin of all[k][i].filter((one) => !outside(one)))
        group.append(s("rect", {
          x: round(x(100 * bin.low) + 0.5), y: round(y(100 * bin.share)), width: round(x(5) - x(0) - 1),
          height: round(y(0) - y(100 * bin.share)), fill: theme.kinds[method.kind],
        }, s("title", {}, `${fixed(100 * bin.low, 0)} to ${fixed(100 * bin.low + 5, 0)} %: ${bin.count} plots`)));
      group.append(line(x(0), panel.top, x(0), panel.top + panel.height, theme.soft));
      const beyond = all[k][i].filter(outside).reduce((sum, bin) => sum + bin.count, 0);
      const words = pairs.length === 0 ? `${name}: none found` : `${name}, n = ${pairs.length}${beyond ? `, ${beyond} beyond` : ""}`;
      svg.append(text(panel.left, panel.top - 4, words, { size: 9.5, colour: theme.soft }));
    });
  });
  return svg;
}

export const histogramsCsv = (methods: Method[]): string => csv([
  ["case", "method", "error_from_percent", "error_to_percent", "plots", "share"],
  ...methods.flatMap((method) => method.groups.flatMap((group) => relativeErrors(group.pairs).map((bin) =>
    [group.name, method.name, Math.round(100 * bin.low), Math.round(100 * bin.low) + 5, bin.count, bin.share]))),
]);

// Estimated against true heights, a panel a case. Where a few estimates lie far away, the axes end before
// them, and it is said how many do.
export function drawScatter(methods: Method[], theme: Theme, narrow: boolean): SVGSVGElement {
  const cases = methods[0]?.groups.map((group) => group.name) ?? [];
  const columns = narrow ? 1 : Math.min(3, Math.max(cases.length, 1));
  const width = columns === 1 ? 360 : 340 * columns;
  const top = 24 + legendHeight(methods, width - 54);
  const side = (width - 8) / columns - 46;
  const pitch = side + 66 + 13 * methods.length;
  const svg = canvas(width, top + pitch * Math.ceil(cases.length / columns) - 14, theme, "Estimated against true heights");
  legend(svg, names(methods, theme), 46, 16, width - 54);
  const every = methods.flatMap((method) => method.groups.flatMap((group) => group.pairs));
  const estimates = every.map((pair) => pair.estimate).sort((a, b) => a - b);
  const truths = every.map((pair) => pair.truth);
  const [low, high] = extremes(every.length ? [...truths, quantile(estimates, 0.02), quantile(estimates, 0.98)] : [], [0, 1]);
  const margin = 0.06 * (high - low || 1);
  const inside = (value: number) => value >= low - margin && value <= high + margin;
  panels(cases.length, columns, width, top, side, pitch).forEach((panel, i) => {
    svg.append(text(panel.left + panel.width / 2, panel.top - 6, cases[i], { anchor: "middle" }));
    const { x, y, group } = frame(svg, panel,
      { low: low - margin, high: high + margin, label: "true height, m" },
      { low: low - margin, high: high + margin, label: i % columns === 0 ? "estimated height, m" : "" }, theme);
    group.append(line(x(low - margin), y(low - margin), x(high + margin), y(high + margin), theme.soft, 1.2));
    methods.forEach((method, k) => {
      const { pairs } = method.groups[i];
      for (const pair of pairs.filter((candidate) => inside(candidate.estimate))) {
        const dot = mark(method.kind, x(pair.truth), y(pair.estimate), 2.3, theme.kinds[method.kind], 0.6);
        dot.append(s("title", {}, `${pair.label}: ${fixed(pair.estimate, 3)} m, truth ${fixed(pair.truth, 3)} m (${method.name})`));
        group.append(dot);
      }
      const beyond = pairs.filter((pair) => !inside(pair.estimate)).length;
      const words = pairs.length === 0 ? "no plots found"
        : `R² ${fixed(r2(pairs), 2)}, within ${fixed(r2Within(pairs), 2)}; RMSE ${fixed(100 * rmse(pairs), 1)} cm; n = ${pairs.length}${beyond ? `, ${beyond} beyond` : ""}`;
      svg.append(mark(method.kind, panel.left + 2, panel.top + side + 41 + 13 * k, 3, theme.kinds[method.kind]),
        text(panel.left + 10, panel.top + side + 45 + 13 * k, words, { size: 10, colour: theme.soft }));
    });
  });
  return svg;
}

export const pairsCsv = (methods: Method[]): string => csv([
  ["case", "method", "plot", "estimate_m", "truth_m", "error_m"],
  ...methods.flatMap((method) => method.groups.flatMap((group) => group.pairs.map((pair) =>
    [group.name, method.name, pair.label, pair.estimate, pair.truth, Math.round(1e5 * error(pair)) / 1e5]))),
]);
