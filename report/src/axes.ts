// Figures as SVG: a frame with ticks, in pixels of a column's width (360 px are 9.5 cm at 96 dpi, text
// of 11 px is 8 points there).
import type { Theme } from "./colours";
import { s } from "./dom";
import { fixed, ticks } from "./numbers";

export interface Scale {
  (value: number): number;
  low: number;
  high: number;
}

export function scale(low: number, high: number, from: number, to: number): Scale {
  const place = (value: number) => from + ((value - low) / (high - low || 1)) * (to - from);
  return Object.assign(place, { low, high });
}

export const round = (value: number): number => Math.round(value * 100) / 100;

// A path's data from place to place.
export const through = (places: [number, number][]): string => places.map(([u, v], i) => `${i ? "L" : "M"}${round(u)} ${round(v)}`).join("");

// One path of dots: thousands of circles would be slow.
export const dots = (places: [number, number][], colour: string, size: number, opacity: number): SVGPathElement =>
  s("path", {
    d: places.map(([u, v]) => `M${u.toFixed(1)} ${v.toFixed(1)}h0`).join(""), stroke: colour, "stroke-width": size,
    "stroke-linecap": "round", "stroke-opacity": opacity, fill: "none" });

const kLetter_px = 6.3; // a letter's width, about

export const font = "system-ui, -apple-system, 'Segoe UI', 'DejaVu Sans', sans-serif";

export function canvas(width: number, height: number, theme: Theme, title: string): SVGSVGElement {
  const svg = s("svg", {
    xmlns: "http://www.w3.org/2000/svg", viewBox: `0 0 ${width} ${height}`, width, height, role: "img",
    "font-family": font, "font-size": 11, fill: theme.ink,
  });
  svg.append(s("title", {}, title), s("rect", { width, height, fill: theme.paper }));
  return svg;
}

export interface TextOptions {
  anchor?: "start" | "middle" | "end";
  colour?: string;
  size?: number;
  bold?: boolean;
  turned?: boolean;
}

export function text(x: number, y: number, words: string, options: TextOptions = {}): SVGTextElement {
  return s("text", {
    x: round(x), y: round(y), "text-anchor": options.anchor ?? "start", fill: options.colour,
    "font-size": options.size, "font-weight": options.bold ? 600 : undefined,
    transform: options.turned ? `rotate(-90 ${round(x)} ${round(y)})` : undefined,
  }, words);
}

export function line(
  x1: number, y1: number, x2: number, y2: number, colour: string, width = 1, dash?: string): SVGLineElement {
  return s("line", {
    x1: round(x1), y1: round(y1), x2: round(x2), y2: round(y2), stroke: colour, "stroke-width": width,
    "stroke-dasharray": dash,
  });
}

// One of the shapes that tell series apart without colour.
export function mark(shape: number, x: number, y: number, size: number, colour: string, opacity = 1): SVGElement {
  const paint = { fill: colour, "fill-opacity": opacity };
  const [u, v] = [round(x), round(y)];
  switch (shape % 4) {
    case 1: return s("rect", { x: round(x - size), y: round(y - size), width: 2 * size, height: 2 * size, ...paint });
    case 2: return s("path", { d: `M${u} ${round(y - 1.3 * size)}l${1.2 * size} ${2.2 * size}h${-2.4 * size}z`, ...paint });
    case 3: return s("path", { d: `M${u} ${round(y - 1.4 * size)}l${1.4 * size} ${1.4 * size}l${-1.4 * size} ${1.4 * size}l${-1.4 * size} ${-1.4 * size}z`, ...paint });
    default: return s("circle", { cx: u, cy: v, r: size, ...paint });
  }
}

export interface Panel {
  left: number;
  top: number;
  width: number;
  height: number;
}

export interface Axis {
  low: number;
  high: number;
  label: string;
  digits?: number;
  count?: number;
  labels?: [number, string][]; // in place of numbers
}

export interface Frame {
  x: Scale;
  y: Scale;
  group: SVGGElement; // clipped to the panel
}

// Decimals that tell ticks apart.
export function digitsOf(values: number[]): number {
  const step = values.length > 1 ? values[1] - values[0] : 1;
  return Math.max(0, Math.min(4, -Math.floor(Math.log10(step) + 1e-9)));
}

// Round numbers from low to high, each with its text: what it is beyond `from`, in as many decimals as tell them apart.
export function tickTexts(low: number, high: number, options: { count?: number; digits?: number; from?: number } = {}): [number, string][] {
  const values = ticks(low, high, options.count);
  return values.map((value) => [value, fixed(value - (options.from ?? 0), options.digits ?? digitsOf(values))]);
}

// How far left of an upright axis its title stands: beyond the widest text at its ticks.
export const besideTicks = (rows: [number, string][]): number =>
  Math.max(34, 14 + kLetter_px * Math.max(0, ...rows.map(([, words]) => words.length)));

let clips = 0;

// A panel's frame, grid and ticks; what is drawn goes into the group.
export function frame(svg: SVGSVGElement, panel: Panel, horizontal: Axis, vertical: Axis, theme: Theme): Frame {
  const { left, top, width, height } = panel;
  const x = scale(horizontal.low, horizontal.high, left, left + width);
  const y = scale(vertical.low, vertical.high, top + height, top);
  const marksOf = (axis: Axis): [number, string][] => axis.labels ?? tickTexts(axis.low, axis.high, axis);
  const rows = marksOf(vertical);
  for (const [value, words] of rows) {
    svg.append(line(left, y(value), left + width, y(value), theme.line),
      text(left - 5, y(value) + 4, words, { anchor: "end", colour: theme.soft }));
  }
  for (const [value, words] of marksOf(horizontal)) {
    if (!horizontal.labels) svg.append(line(x(value), top, x(value), top + height, theme.line));
    svg.append(text(x(value), top + height + 14, words, { anchor: "middle", colour: theme.soft }));
  }
  svg.append(line(left, top + height, left + width, top + height, theme.soft), line(left, top, left, top + height, theme.soft));
  if (horizontal.label)
    svg.append(text(left + width / 2, top + height + 29, horizontal.label, { anchor: "middle" }));
  if (vertical.label) svg.append(text(left - besideTicks(rows), top + height / 2, vertical.label, { anchor: "middle", turned: true }));
  const clip = `clip${++clips}`;
  const group = s("g", { "clip-path": `url(#${clip})` });
  svg.append(s("clipPath", { id: clip }, s("rect", { x: left - 6, y: top - 6, width: width + 12, height: height + 6 })), group);
  return { x, y, group };
}

export interface LegendEntry {
  name: string;
  colour: string;
  shape?: number;
  dash?: string; // of a line in place of a mark; "" is solid
  edge?: string; // of a hollow mark
}

const entryWidth = (name: string): number => 26 + kLetter_px * name.length;

// The height that a legend takes.
export function legendHeight(names: { name: string }[], width: number): number {
  let lines = 1;
  let x = 0;
  for (const { name } of names) {
    if (x > 0 && x + entryWidth(name) - 6 > width) {
      ++lines;
      x = 0;
    }
    x += entryWidth(name);
  }
  return 15 * lines + 6;
}

// Names of series with their marks, in as many lines as they need.
export function legend(svg: SVGSVGElement, names: LegendEntry[], left: number, top: number, width: number): void {
  let x = left;
  let y = top;
  for (const { name, colour, shape, dash, edge } of names) {
    const size = entryWidth(name);
    if (x > left && x + size - 6 > left + width) {
      x = left;
      y += 15;
    }
    const sign = dash !== undefined ? line(x, y - 4, x + 12, y - 4, colour, 1.6, dash) : mark(shape ?? 1, x + 6, y - 4, 4, colour);
    if (edge) sign.setAttribute("stroke", edge);
    svg.append(sign, text(x + 16, y, name));
    x += size;
  }
}
