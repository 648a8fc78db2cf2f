// The plots from above, coloured by what is asked of them.
import { besideTicks, canvas, line, round, text, tickTexts, type Panel } from "./axes";
import { corners } from "./boxes";
import { cividis, heightRamp, hex, signs, type Ramp, type Rgb, type Theme } from "./colours";
import type { Box, Field, Plot } from "./data";
import { s } from "./dom";
import { flagsOf } from "./heights";
import { counted, csv, extremes, fixed, namedTruth } from "./numbers";

export type Measure = "height" | "error" | "interval" | "confidence" | "truth";

export function measured(plot: Plot, measure: Measure, height: string): number {
  const value = plot.heights[height];
  const truth = plot.truths[namedTruth(height)];
  switch (measure) {
    case "height": return value?.[0] ?? NaN;
    case "truth": return truth ?? NaN;
    case "error": return value && truth !== undefined && truth !== null ? value[0] - truth : NaN;
    case "interval": return value && value[2] !== null && value[3] !== null ? value[3] - value[2] : NaN;
    case "confidence": return plot.confidence ?? NaN;
  }
}

export const measureNames: Record<Measure, string> = {
  height: "height", truth: "true height", error: "error (estimate − truth)", interval: "width of the 95 % interval",
  confidence: "confidence",
};

export interface Colours {
  low: number;
  high: number;
  ramp: Ramp;
}

// The range of a measure over the plots: symmetric for errors, 0 to 1 for confidence.
export function coloursOf(values: number[], measure: Measure): Colours {
  const known = values.filter(Number.isFinite);
  if (measure === "confidence") return { low: 0, high: 1, ramp: cividis };
  let [low, high] = extremes(known, [0, 1]);
  if (measure === "error") {
    high = Math.max(-low, high, 0.5);
    return { low: -high, high, ramp: signs };
  }
  if (high - low < 1e-3) [low, high] = [low - 0.01, high + 0.01];
  return { low, high, ramp: measure === "interval" ? cividis : heightRamp };
}

const share = (colours: Colours, value: number): number => (value - colours.low) / (colours.high - colours.low);

// An upright bar of colours with its ticks.
function colourBar({ svg, panel, theme }: Sheet, colours: Colours, title: string): void {
  const [left, top, height] = [kWidth - 78, panel.top + 20, panel.height - 40];
  const steps = 48;
  for (let i = 0; i < steps; ++i)
    svg.append(s("rect", {
      x: left, y: round(top + height * (1 - (i + 1) / steps)), width: 12, height: round(height / steps + 0.6),
      fill: hex(colours.ramp((i + 0.5) / steps)) }));
  for (const [value, words] of tickTexts(colours.low, colours.high)) {
    const y = top + height * (1 - share(colours, value));
    svg.append(line(left + 12, y, left + 16, y, theme.soft), text(left + 19, y + 4, words, { colour: theme.soft }));
  }
  svg.append(text(left + 66, top + height / 2, title, { anchor: "middle", turned: true }));
}

const luminance = ([r, g, b]: Rgb): number => (0.3 * r + 0.59 * g + 0.11 * b) / 255;

export interface MapOptions {
  field: Field;
  measure: Measure;
  height: string;
  selected?: Plot;
  pick?: (plot: Plot) => void;
}

// From the field's metres to the drawing's pixels.
export interface Sheet {
  svg: SVGSVGElement;
  panel: Panel;
  theme: Theme;
  scale: number; // pixels a metre
  at: (x: number, y: number) => [number, number];
}

// Large coordinates count from a round one near the middle, which the axis names.
function roundOrigin(middle: number, span: number): number {
  const step = span < 50 ? 100 : 1000;
  return Math.abs(middle) < 5 * step ? 0 : step * Math.round(middle / step);
}
const axisName = (name: string, from: number): string => (from ? `${name} less ${counted(from)}, m` : `${name}, m`);

const kWidth = 460;
const kHeight = 400;
export const kAxis = 56; // room for an upright axis

// An empty map with the axes of the cloud's coordinates.
function sheetOf(field: Field, title: string, theme: Theme): Sheet {
  const svg = canvas(kWidth, kHeight, theme, title);
  return sheetIn(svg, { left: kAxis, top: 10, width: kWidth - kAxis - 86, height: kHeight - 10 - 40 }, [...field.plots, ...field.true_boxes].map(({ box }) => box), theme);
}

// The same in a panel of a figure, around boxes.
export function sheetIn(svg: SVGSVGElement, panel: Panel, boxes: Box[], theme: Theme): Sheet {
  const outlines = boxes.flatMap(corners);
  const [west, east] = extremes(outlines.map(([x]) => x), [-0.5, 0.5]);
  const [south, north] = extremes(outlines.map(([, y]) => y), [-0.5, 0.5]);
  const [x0, y0] = [(west + east) / 2, (south + north) / 2];
  const scale = Math.min(panel.width / (east - west || 1), panel.height / (north - south || 1)) * 0.96;
  const [left, top] = [panel.left + panel.width / 2, panel.top + panel.height / 2];
  const bottom = panel.top + panel.height;
  const right = panel.left + panel.width;
  const [fromX, fromY] = [roundOrigin(x0, east - west), roundOrigin(y0, north - south)];
  const rows = tickTexts(y0 - panel.height / scale / 2, y0 + panel.height / scale / 2, { from: fromY });
  for (const [x, words] of tickTexts(x0 - panel.width / scale / 2, x0 + panel.width / scale / 2, { from: fromX })) {
    const u = left + (x - x0) * scale;
    svg.append(line(u, panel.top, u, bottom, theme.line), text(u, bottom + 14, words, { anchor: "middle", colour: theme.soft }));
  }
  for (const [y, words] of rows) {
    const v = top - (y - y0) * scale;
    svg.append(line(panel.left, v, right, v, theme.line), text(panel.left - 5, v + 4, words, { anchor: "end", colour: theme.soft }));
  }
  svg.append(text(left, bottom + 32, axisName("east", fromX), { anchor: "middle" }),
    text(panel.left - besideTicks(rows), top, axisName("north", fromY), { anchor: "middle", turned: true }));
  return { svg, panel, theme, scale, at: (x, y) => [left + (x - x0) * scale, top - (y - y0) * scale] };
}

export const cornersOn = (sheet: Sheet, box: Box): string =>
  corners(box).map(([x, y]) => sheet.at(x, y).map(round).join(",")).join(" ");

// A plot's number where its box has room for it, along the box where that is narrow.
function numberOn(sheet: Sheet, plot: Plot, fill: Rgb | undefined): SVGTextElement | undefined {
  const room = Math.min(plot.box[2], plot.box[3]) * sheet.scale;
  if (room <= 9 || plot.id.length * 5 >= Math.max(room, plot.box[3] * sheet.scale * 0.9)) return undefined;
  const [u, v] = sheet.at(plot.box[0], plot.box[1]);
  const colour = fill === undefined ? sheet.theme.ink : luminance(fill) < 0.52 ? "#ffffff" : "#1c2128";
  const label = text(u, v + 3.5, plot.id, { anchor: "middle", size: 10, colour });
  const heading = ((plot.box[4] % 180) + 180) % 180;
  if (plot.id.length * 6 > room)
    label.setAttribute("transform", `rotate(${round(heading > 90 ? 180 - heading : -heading)} ${round(u)} ${round(v)})`);
  return label;
}

// Chosen by a click, Enter or the space bar; arrows choose the neighbours.
function makeChoosable(group: SVGGElement, plots: Plot[], i: number, pick: (plot: Plot) => void): void {
  group.addEventListener("click", () => pick(plots[i]));
  group.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
    if (!step && event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    pick(plots[(i + (step ?? 0) + plots.length) % plots.length]);
  });
}

export function drawMap({ field, measure, height, selected, pick }: MapOptions, theme: Theme): SVGSVGElement {
  const sheet = sheetOf(field, `Map of the plots: ${measureNames[measure]}`, theme);
  const centimetres = measure === "error" || measure === "interval";
  const unit = measure === "confidence" ? "" : centimetres ? "cm" : "m";
  const values = field.plots.map((plot) => (centimetres ? 100 : 1) * measured(plot, measure, height));
  const colours = coloursOf(values, measure);
  field.plots.forEach((plot, i) => {
    const fill = Number.isFinite(values[i]) ? colours.ramp(share(colours, values[i])) : undefined;
    const chosen = plot === selected;
    const flags = flagsOf(plot, measure === "confidence" ? "" : height);
    const words = `plot ${plot.id}: ${fill ? `${fixed(values[i], centimetres ? 1 : 3)} ${unit}` : "no value"}`;
    const group = s("g", pick ? {
      class: "plot", role: "button", tabindex: chosen || (!selected && i === 0) ? 0 : -1, "aria-label": words,
      "data-plot": plot.id, "aria-pressed": chosen ? "true" : "false" } : {},
    s("polygon", {
      points: cornersOn(sheet, plot.box), fill: fill ? hex(fill) : theme.paper,
      stroke: chosen ? "#e69f00" : flags.length ? theme.kinds[1] : theme.ink,
      "stroke-width": chosen ? 3 : flags.length ? 1.8 : 0.6,
    }, s("title", {}, words + (flags.length ? ` (${flags.join("; ")})` : ""))));
    const number = numberOn(sheet, plot, fill);
    if (number) group.append(number);
    if (pick) makeChoosable(group, field.plots, i, pick);
    sheet.svg.append(group);
  });
  for (const plot of field.true_boxes.filter((box) => !box.found))
    sheet.svg.append(s("polygon", { points: cornersOn(sheet, plot.box), fill: "none", stroke: theme.kinds[0], "stroke-dasharray": "3 2" }, s("title", {}, `missed: plot ${plot.id}`)));
  const name = measure === "confidence" ? "confidence" : `${height ? `${height}: ` : ""}${measureNames[measure].replace(" (estimate − truth)", "")}, ${unit}`;
  if (values.some(Number.isFinite)) colourBar(sheet, colours, name);
  return sheet.svg;
}

export function mapCsv(field: Field, measure: Measure, height: string): string {
  const trials = field.plots.some((plot) => plot.trial);
  return csv([
    ["plot", ...(trials ? ["trial"] : []), "row", "column", "center_x_m", "center_y_m", "width_m", "length_m", "heading_deg", measure === "confidence" ? measure : `${height}_${measure}_m`, "flags"],
    ...field.plots.map((plot) => [plot.id, ...(trials ? [plot.trial ?? ""] : []), plot.row || "", plot.column || "", ...plot.box, measured(plot, measure, height), plot.flags.join("; ")]),
  ]);
}
