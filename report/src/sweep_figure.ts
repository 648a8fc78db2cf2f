// Which flight a field needs: a measure over two options of the flight as contours, a panel for each
// combination of the others; over one option as lines.
import { canvas, digitsOf, frame, legend, legendHeight, line, mark, round, text, through, type Axis, type Frame, type LegendEntry, type Panel } from "./axes";
import { cividis, hex, viridis, type Ramp, type Theme } from "./colours";
import { bands, contourLines, type Nodes } from "./contours";
import type { Sweep } from "./data";
import { s } from "./dom";
import { fixed, ticks } from "./numbers";
import { axisName, reaches, shortest, told, type Flight, type Goal, type Value } from "./sweep_data";

export type SweepMeasure = "rmse" | "found" | "within" | "bias" | "seconds";

export const sweepMeasures: Record<SweepMeasure, { name: string; unit: string; of: (flight: Flight) => number; digits: number }> = {
  rmse: { name: "RMSE of heights", unit: "cm", of: (flight) => 100 * flight.rmse, digits: 1 },
  found: { name: "plots found", unit: "%", of: (flight) => (100 * flight.found) / flight.plots, digits: 0 },
  within: { name: "error within fields", unit: "cm", of: (flight) => 100 * flight.within, digits: 1 },
  bias: { name: "bias of heights", unit: "cm", of: (flight) => 100 * flight.bias, digits: 1 },
  seconds: { name: "time in flight", unit: "s", of: (flight) => flight.seconds, digits: 0 },
};

export interface SweepOptions {
  sweep: Sweep;
  flights: Flight[];
  measure: SweepMeasure;
  x: number; // the axis that goes to the right
  y?: number; // the axis that goes up; without one, the measure does
  goal: Goal;
}

const isNumbers = (values: Value[]): values is number[] => values.every((value) => typeof value === "number");

// Axes whose values are numbers, two at least.
export const numberAxes = ({ axes }: Sweep): number[] =>
  axes.map((_, i) => i).filter((i) => axes[i].values.length > 1 && isNumbers(axes[i].values));

// Where values stand: evenly by their ratio where they span much, else as they are.
function scaleOf(values: number[]): (value: number) => number {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  return low > 0 && high >= 4 * low ? Math.log2 : (value) => value;
}

// Names stand side by side in their order.
function axisOf(sweep: Sweep, axis: number, margin: number): Axis & { place: (value: Value) => number } {
  const { values } = sweep.axes[axis];
  const place = isNumbers(values) ? (scaleOf(values) as (value: Value) => number) : (value: Value) => values.indexOf(value);
  const places = values.map(place);
  const [low, high] = [Math.min(...places), Math.max(...places)];
  const { name, unit } = axisName(sweep.axes[axis].key);
  return {
    low: low - margin * (high - low || 1), high: high + margin * (high - low || 1), label: unit ? `${name}, ${unit}` : name,
    labels: values.map((value) => [place(value), String(value)]), place };
}

interface PanelFlights {
  title: string;
  flights: Flight[];
}

// The flights that differ in the shown axes alone, with what they have in common as a title.
export function panelsOf(sweep: Sweep, flights: Flight[], shown: (number | undefined)[]): PanelFlights[] {
  const others = sweep.axes.map((_, i) => i).filter((i) => !shown.includes(i));
  const groups = new Map<string, PanelFlights>();
  for (const flight of flights) {
    const title = others.map((i) => told(sweep.axes[i].key, flight.values[i])).join(", ");
    if (!groups.has(title)) groups.set(title, { title, flights: [] });
    groups.get(title)!.flights.push(flight);
  }
  return [...groups.values()];
}

function nodesOf(flights: Flight[], { sweep, measure, x, y }: SweepOptions): Nodes {
  const sorted = (axis: number) => {
    const values = sweep.axes[axis].values as number[];
    return { values: [...values].sort((a, b) => a - b), place: scaleOf(values) };
  };
  const [right, up] = [sorted(x), sorted(y!)];
  return {
    xs: right.values.map(right.place), ys: up.values.map(up.place),
    values: up.values.map((v) => right.values.map((u) => {
      const flight = flights.find(({ values }) => values[x] === u && values[y!] === v);
      return flight ? sweepMeasures[measure].of(flight) : NaN;
    })) };
}

interface Bands {
  levels: number[];
  ramp: Ramp;
}

const colourOf = ({ levels, ramp }: Bands, band: number): string => hex(ramp(levels.length ? band / levels.length : 0.5));

function bandsOf(values: number[], measure: SweepMeasure): Bands {
  const known = values.filter(Number.isFinite);
  const [low, high] = [Math.min(...known), Math.max(...known)];
  return { levels: known.length ? ticks(low, high, 6).filter((level) => level > low && level < high) : [], ramp: measure === "found" ? viridis : cividis };
}

// Words that are read on any colour.
function onColour(words: SVGTextElement, theme: Theme): SVGTextElement {
  for (const [name, value] of [["stroke", theme.paper], ["stroke-width", "2.6"], ["stroke-linejoin", "round"], ["paint-order", "stroke"]])
    words.setAttribute(name, value);
  return words;
}

// Bands and lines of equal value; a line has its value where it is longest about the panel's middle.
function drawContours({ x, y, group }: Frame, nodes: Nodes, colours: Bands, theme: Theme): void {
  bands(nodes, colours.levels).forEach((squares, band) => {
    if (squares.length === 0) return;
    const d = squares.map(([x0, y0, x1, y1]) => `M${round(x(x0))} ${round(y(y0))}H${round(x(x1) + 0.3)}V${round(y(y1) - 0.3)}H${round(x(x0))}z`).join("");
    group.append(s("path", { d, fill: colourOf(colours, band) }));
  });
  for (const level of colours.levels) {
    const pieces = contourLines(nodes, level);
    if (pieces.length === 0) continue;
    const d = pieces.map((ends) => through(ends.map(([u, v]) => [x(u), y(v)]))).join("");
    group.append(s("path", { d, stroke: theme.paper, "stroke-width": 1.2, "stroke-opacity": 0.85, fill: "none" }));
  }
}

function drawFlight({ x, y, group }: Frame, at: [number, number], flight: Flight, options: SweepOptions, best: Flight | undefined, theme: Theme): void {
  const { measure, sweep, goal } = options;
  const { of, digits, unit } = sweepMeasures[measure];
  const value = of(flight);
  const [u, v] = [x(at[0]), y(at[1])];
  const enough = reaches(flight, goal);
  const words = `${flight.values.map((one, i) => told(sweep.axes[i].key, one)).join(", ")}: ${fixed(value, digits + 1)} ${unit}, n = ${flight.found} of ${flight.plots} plots`;
  const size = flight === best ? 5.5 : 3.4;
  const dot = flight === best ? mark(3, u, v, size, theme.kinds[4]) : mark(0, u, v, size, enough ? theme.ink : theme.paper);
  dot.setAttribute("stroke", enough ? theme.paper : theme.ink);
  dot.setAttribute("stroke-width", "1.1");
  dot.append(s("title", {}, words));
  group.append(dot, onColour(text(u, v - 5 - size, fixed(value, digits), { anchor: "middle", size: 9.5, colour: theme.ink }), theme));
}

// The colours of the bands with the levels between them, below the panels.
function drawKey(svg: SVGSVGElement, colours: Bands, left: number, top: number, width: number, title: string, theme: Theme): void {
  const count = colours.levels.length + 1;
  const each = Math.min(46, (width - 8) / count);
  svg.append(text(left, top - 5, title));
  for (let band = 0; band < count; ++band)
    svg.append(s("rect", { x: round(left + band * each), y: top, width: round(each), height: 11, fill: colourOf(colours, band), stroke: theme.soft, "stroke-width": 0.5 }));
  colours.levels.forEach((level, i) =>
    svg.append(text(left + (i + 1) * each, top + 23, fixed(level, digitsOf(colours.levels)), { anchor: "middle", colour: theme.soft })));
}

const kGap = 52;

// As many panels side by side as the last of the other axes has values, up to three.
function columnsOf(sweep: Sweep, shown: (number | undefined)[], count: number): number {
  const last = sweep.axes.filter((_, i) => !shown.includes(i)).at(-1);
  const values = last?.values.length ?? 1;
  return values >= 2 && values <= 3 ? values : Math.min(count, 3);
}

function grid(count: number, columns: number, top: number, narrow: boolean): { panels: Panel[]; width: number; bottom: number } {
  if (narrow) columns = 1;
  const width = narrow ? 360 : Math.max(360, 340 * columns);
  const each = (width - 10) / columns - kGap;
  const panels = Array.from({ length: count }, (_, i) => ({
    left: kGap + (i % columns) * (each + kGap), top: top + 262 * Math.floor(i / columns), width: each, height: 200 }));
  return { panels, width, bottom: top + 262 * Math.ceil(count / columns) };
}

const goalText = ({ rmse, found }: Goal): string => `RMSE ≤ ${Number((100 * rmse).toPrecision(3))} cm, found ≥ ${Number((100 * found).toPrecision(4))} %`;

// The marks that are drawn.
export function marksLegend(theme: Theme, flights: Flight[], goal: Goal): LegendEntry[] {
  const best = shortest(flights, goal);
  const entries: LegendEntry[] = [];
  const others = flights.some((flight) => flight !== best && reaches(flight, goal));
  if (others) entries.push({ name: `good enough: ${goalText(goal)}`, colour: theme.ink, shape: 0 });
  if (flights.some((flight) => !reaches(flight, goal)))
    entries.push({ name: others ? "not good enough" : `not: ${goalText(goal)}`, colour: theme.paper, edge: theme.ink, shape: 0 });
  if (best) entries.push({ name: "the shortest that is good enough", colour: theme.kinds[4], shape: 3 });
  return entries;
}

// What the figure shows beside a height and its truth, in words.
export function sweepNote(options: SweepOptions): string {
  const { sweep, flights, measure, x, y } = options;
  const most = (of: (flight: Flight) => number) => Math.max(0, ...flights.map(of).filter(Number.isFinite));
  const farms = most((flight) => flight.farms);
  const said = [`; n: ${farms} farm${farms === 1 ? "" : "s"}, ${most((flight) => flight.plots)} plots a mark.`];
  if (y !== undefined)
    return [...said, "Marks are the flights that were flown, with their values; between them the values are interpolated."].join(" ");
  const lines = panelsOf(sweep, flights, [x]).length;
  said.push("Marks are the flights that were flown.");
  if (hasIntervals(flights, measure)) said.push("Bars: 95 % intervals by the bootstrap over farms.");
  if (lines > kMostLines) said.push(`The first ${kMostLines} of ${lines} lines; the CSV has all flights.`);
  return said.join(" ");
}

const hasIntervals = (flights: Flight[], measure: SweepMeasure): boolean => measure === "rmse" && flights.some(({ low }) => Number.isFinite(low));

export function drawSweep(options: SweepOptions, theme: Theme, narrow: boolean): SVGSVGElement {
  return options.y === undefined ? drawLines(options, theme, narrow) : drawMaps(options, theme, narrow);
}

function drawMaps(options: SweepOptions, theme: Theme, narrow: boolean): SVGSVGElement {
  const { sweep, flights, measure, x, y, goal } = options;
  const { name, unit, of } = sweepMeasures[measure];
  const groups = panelsOf(sweep, flights, [x, y]);
  const best = shortest(flights, goal);
  const entries = marksLegend(theme, flights, goal);
  const columns = columnsOf(sweep, [x, y], groups.length);
  const { width: room } = grid(groups.length, columns, 0, narrow);
  const top = 26 + legendHeight(entries, room - kGap - 8);
  const { panels, width, bottom } = grid(groups.length, columns, top, narrow);
  const svg = canvas(width, bottom + 34, theme, `${name} by flight`);
  legend(svg, entries, kGap, 16, width - kGap - 8);
  const colours = bandsOf(flights.map(of), measure);
  const [right, up] = [axisOf(sweep, x, 0.1), axisOf(sweep, y!, 0.14)];
  groups.forEach(({ title, flights: own }, i) => {
    const panel = panels[i];
    svg.append(text(panel.left + panel.width / 2, panel.top - 6, title, { anchor: "middle", size: 10.5 }));
    const drawn = frame(svg, panel, right, { ...up, label: panel.left === kGap ? up.label : "" }, theme);
    drawContours(drawn, nodesOf(own, options), colours, theme);
    for (const flight of own)
      drawFlight(drawn, [right.place(flight.values[x]), up.place(flight.values[y!])], flight, options, best, theme);
  });
  drawKey(svg, colours, kGap, bottom, width - kGap - 8, `${name}, ${unit}`, theme);
  return svg;
}

const kMostLines = 7;

// One axis of numbers: a line for each combination of the others, its RMSE with the 95 % interval.
function drawLines(options: SweepOptions, theme: Theme, narrow: boolean): SVGSVGElement {
  const { sweep, flights, measure, x, goal } = options;
  const { name, unit, of } = sweepMeasures[measure];
  const groups = panelsOf(sweep, flights, [x]).slice(0, kMostLines);
  const width = narrow ? 360 : 560;
  const entries: LegendEntry[] = groups.map(({ title }, i) => ({ name: title || name, colour: theme.kinds[i], shape: i }));
  const top = 8 + legendHeight(entries, width - 60);
  const svg = canvas(width, top + 246, theme, `${name} by flight`);
  legend(svg, entries, 50, 16, width - 60);
  const ends = flights.flatMap((flight) => (measure === "rmse" ? [of(flight), 100 * flight.high] : [of(flight)])).filter(Number.isFinite);
  const right = axisOf(sweep, x, 0.06);
  const drawn = frame(svg, { left: 50, top, width: width - 60, height: 200 }, right,
    { low: Math.min(0, ...ends), high: 1.08 * Math.max(0.1, ...ends), label: `${name}, ${unit}` }, theme);
  groups.forEach(({ flights: own }, i) => {
    const known = own.filter((flight) => Number.isFinite(of(flight)));
    const places = known.map((flight): [number, number] => [drawn.x(right.place(flight.values[x])), drawn.y(of(flight))]);
    drawn.group.append(s("path", { d: through(places), stroke: theme.kinds[i], "stroke-width": 1.6, fill: "none" }));
    known.forEach((flight, k) => {
      const [u, v] = places[k];
      if (measure === "rmse" && Number.isFinite(flight.low))
        drawn.group.append(line(u, drawn.y(100 * flight.low), u, drawn.y(100 * flight.high), theme.kinds[i], 1.3));
      const dot = mark(i, u, v, 3.6, theme.kinds[i]);
      dot.append(s("title", {}, `${flight.values.map((one, axis) => told(sweep.axes[axis].key, one)).join(", ")}: ${fixed(of(flight), 2)} ${unit}${reaches(flight, goal) ? ", good enough" : ""}`));
      drawn.group.append(dot);
    });
  });
  return svg;
}
