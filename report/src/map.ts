// The plots from above, coloured by what is asked of them.
import { canvas, font, line, round, text } from "./axes";
import { cividis, hex, signs, viridis, type Ramp, type Theme } from "./colours";
import type { Field, Plot } from "./data";
import { s } from "./dom";
import { csv, fixed, namedTruth, ticks } from "./numbers";
import { corners } from "./place";

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
  let low = known.length ? Math.min(...known) : 0;
  let high = known.length ? Math.max(...known) : 1;
  if (measure === "error") {
    high = Math.max(-low, high, 0.5);
    return { low: -high, high, ramp: signs };
  }
  if (high - low < 1e-3) [low, high] = [low - 0.01, high + 0.01];
  return { low, high, ramp: measure === "interval" ? cividis : viridis };
}

const share = (colours: Colours, value: number): number => (value - colours.low) / (colours.high - colours.low);

// An upright bar of colours with its ticks.
function colourBar(svg: SVGSVGElement, colours: Colours, left: number, top: number, height: number, title: string, theme: Theme, digits: number): void {
  const steps = 48;
  for (let i = 0; i < steps; ++i)
    svg.append(s("rect", {
      x: left, y: round(top + height * (1 - (i + 1) / steps)), width: 12, height: round(height / steps + 0.6),
      fill: hex(colours.ramp((i + 0.5) / steps)) }));
  for (const value of ticks(colours.low, colours.high, 5)) {
    const y = top + height * (1 - share(colours, value));
    svg.append(line(left + 12, y, left + 16, y, theme.soft), text(left + 19, y + 4, fixed(value, digits), { colour: theme.soft }));
  }
  svg.append(text(left + 66, top + height / 2, title, { anchor: "middle", turned: true }));
}

const luminance = ([r, g, b]: [number, number, number]): number => (0.3 * r + 0.59 * g + 0.11 * b) / 255;

export interface MapOptions {
  field: Field;
  measure: Measure;
  height: string;
  selected?: Plot;
  pick?: (plot: Plot) => void;
}

export function drawMap({ field, measure, height, selected, pick }: MapOptions, theme: Theme): SVGSVGElement {
  const [width, total] = [460, 400];
  const panel = { left: 46, top: 10, width: width - 46 - 86, height: total - 10 - 40 };
  const svg = canvas(width, total, theme, `Map of the plots: ${measureNames[measure]}`);
  const outlines = [...field.plots, ...field.true_boxes].flatMap((plot) => corners(plot.box));
  const xs = outlines.map(([x]) => x);
  const ys = outlines.map(([, y]) => y);
  const [x0, x1, y0, y1] = xs.length ? [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)] : [0, 1, 0, 1];
  const scale = Math.min(panel.width / (x1 - x0 || 1), panel.height / (y1 - y0 || 1)) * 0.96;
  const at = (x: number, y: number): [number, number] => [
    panel.left + panel.width / 2 + (x - (x0 + x1) / 2) * scale,
    panel.top + panel.height / 2 - (y - (y0 + y1) / 2) * scale,
  ];
  const spanX = panel.width / scale / 2;
  const spanY = panel.height / scale / 2;
  for (const x of ticks((x0 + x1) / 2 - spanX, (x0 + x1) / 2 + spanX, 5)) {
    const [u] = at(x, 0);
    svg.append(line(u, panel.top, u, panel.top + panel.height, theme.line), text(u, panel.top + panel.height + 14, fixed(x, 0), { anchor: "middle", colour: theme.soft }));
  }
  for (const y of ticks((y0 + y1) / 2 - spanY, (y0 + y1) / 2 + spanY, 5)) {
    const [, v] = at(0, y);
    svg.append(line(panel.left, v, panel.left + panel.width, v, theme.line), text(panel.left - 5, v + 4, fixed(y, 0), { anchor: "end", colour: theme.soft }));
  }
  svg.append(text(panel.left + panel.width / 2, total - 8, "east, m", { anchor: "middle" }),
    text(12, panel.top + panel.height / 2, "north, m", { anchor: "middle", turned: true }));
  const centimetres = measure === "error" || measure === "interval";
  const factor = centimetres ? 100 : 1;
  const values = field.plots.map((plot) => factor * measured(plot, measure, height));
  const colours = coloursOf(values, measure);
  const points = (box: Plot["box"]) => corners(box).map(([x, y]) => at(x, y).map(round).join(",")).join(" ");
  const all = s("g");
  field.plots.forEach((plot, i) => {
    const known = Number.isFinite(values[i]);
    const colour = known ? colours.ramp(share(colours, values[i])) : undefined;
    const chosen = plot === selected;
    const unit = measure === "confidence" ? "" : centimetres ? " cm" : " m";
    const words = `plot ${plot.id}: ${known ? fixed(values[i], centimetres ? 1 : 3) + unit : "no value"}`;
    const shape = s("polygon", {
      points: points(plot.box), fill: colour ? hex(colour) : theme.paper,
      stroke: chosen ? "#e69f00" : plot.flags.length ? theme.kinds[1] : theme.ink, "stroke-width": chosen ? 3 : plot.flags.length ? 1.8 : 0.6,
    }, s("title", {}, words + (plot.flags.length ? ` (${plot.flags.join("; ")})` : "")));
    const [u, v] = at(plot.box[0], plot.box[1]);
    const room = Math.min(plot.box[2], plot.box[3]) * scale;
    const group = s("g", pick
      ? { class: "plot", role: "button", tabindex: chosen || (!selected && i === 0) ? 0 : -1, "aria-label": words, "data-plot": plot.id, "aria-pressed": chosen ? "true" : "false" }
      : {}, shape);
    if (room > 9 && plot.id.length * 5 < Math.max(room, plot.box[3] * scale * 0.9)) {
      const upright = plot.id.length * 6 > room;
      const heading = ((plot.box[4] % 180) + 180) % 180;
      const label = text(u, v + 3.5, plot.id, { anchor: "middle", size: 10, colour: colour && luminance(colour) < 0.52 ? "#ffffff" : colour ? "#1c2128" : theme.ink });
      if (upright) label.setAttribute("transform", `rotate(${round(heading > 90 ? 180 - heading : -heading)} ${round(u)} ${round(v)})`);
      group.append(label);
    }
    if (pick) {
      group.addEventListener("click", () => pick(plot));
      group.addEventListener("keydown", (event) => {
        const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[(event as KeyboardEvent).key];
        const enter = ["Enter", " "].includes((event as KeyboardEvent).key);
        if (!step && !enter) return;
        event.preventDefault();
        pick(step ? field.plots[(i + step + field.plots.length) % field.plots.length] : plot);
      });
    }
    all.append(group);
  });
  svg.append(all);
  for (const plot of field.true_boxes)
    if (!plot.found) svg.append(s("polygon", { points: points(plot.box), fill: "none", stroke: theme.kinds[0], "stroke-dasharray": "3 2" }, s("title", {}, `missed: plot ${plot.id}`)));
  const unit = measure === "confidence" ? "" : centimetres ? ", cm" : ", m";
  const title = measure === "confidence" ? "confidence" : `${height ? height + ": " : ""}${measureNames[measure].replace(" (estimate − truth)", "")}${unit}`;
  if (values.some(Number.isFinite))
    colourBar(svg, colours, width - 78, panel.top + 20, panel.height - 40, title, theme, centimetres ? 1 : 2);
  svg.setAttribute("font-family", font);
  return svg;
}

export function mapCsv(field: Field, measure: Measure, height: string): string {
  return csv([
    ["plot", "row", "column", "center_x_m", "center_y_m", "width_m", "length_m", "heading_deg", measure === "confidence" ? measure : `${height}_${measure}_m`, "flags"],
    ...field.plots.map((plot) => [plot.id, plot.row || "", plot.column || "", ...plot.box, measured(plot, measure, height), plot.flags.join("; ")]),
  ]);
}
