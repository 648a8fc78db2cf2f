// A plot from the side: its points, the ground, heights with their intervals, truths.
import { canvas, frame, legend, legendHeight, line, round, text, type LegendEntry } from "./axes";
import type { Theme } from "./colours";
import type { Box, Cloud, Plot } from "./data";
import type { TilePoints } from "./decode";
import { s } from "./dom";
import { csv, fixed, namedTruth } from "./numbers";
import type { Grounds } from "./place";

const kBeyond = 1; // metres that are shown before and behind the plot
const kMostPoints = 9000;
const kHeightKinds = [0, 1, 3]; // colours of the heights

// A point beside the plot's middle: along its length from the box's start, across, up.
export interface SidePoint {
  along: number;
  z: number;
  above: number; // the fitted ground; NaN where there is none
  inside: boolean; // the box, not beyond its ends
}

// The points between the plot's long sides.
export function pointsOf(plot: Plot, cloud: Cloud, tiles: TilePoints[], grounds: Grounds): SidePoint[] {
  const [x0, y0, width, length, heading] = plot.box;
  const [c, d] = [Math.cos((heading * Math.PI) / 180), Math.sin((heading * Math.PI) / 180)];
  const reach = Math.hypot(width, length + 2 * kBeyond) / 2;
  const found: SidePoint[] = [];
  for (const { tile, places } of tiles) {
    const left = tile.low[0] + cloud.origin[0];
    const south = tile.low[1] + cloud.origin[1];
    if (left > x0 + reach || south > y0 + reach) continue;
    if (tile.high[0] + cloud.origin[0] < x0 - reach || tile.high[1] + cloud.origin[1] < y0 - reach) continue;
    const up = tile.low[2] + cloud.origin[2];
    for (let i = 0; i < tile.n; ++i) {
      const x = left + tile.step * places[4 * i] - x0;
      const y = south + tile.step * places[4 * i + 1] - y0;
      const along = x * c + y * d;
      if (Math.abs(y * c - x * d) > width / 2 || Math.abs(along) > length / 2 + kBeyond) continue;
      const z = up + tile.step * places[4 * i + 2];
      found.push({
        along: along + length / 2, z, above: z - (grounds.ground?.height(x + x0, y + y0) ?? NaN),
        inside: Math.abs(along) <= length / 2,
      });
    }
  }
  return found;
}

// A line of ground along the plot's middle, in pieces without gaps.
function groundLine(box: Box, height: (x: number, y: number) => number): [number, number][][] {
  const [x0, y0, , length, heading] = box;
  const [c, d] = [Math.cos((heading * Math.PI) / 180), Math.sin((heading * Math.PI) / 180)];
  const pieces: [number, number][][] = [[]];
  const steps = 120;
  for (let i = 0; i <= steps; ++i) {
    const along = -kBeyond + ((length + 2 * kBeyond) * i) / steps;
    const from = along - length / 2;
    const z = height(x0 + from * c, y0 + from * d);
    if (Number.isFinite(z)) pieces[pieces.length - 1].push([along, z]);
    else if (pieces[pieces.length - 1].length > 0) pieces.push([]);
  }
  return pieces.filter((piece) => piece.length > 1);
}

// The heights that a profile shows: those asked for that the plot has, else the first three.
export function profileHeights(plot: Plot, first: string): string[] {
  const names = Object.keys(plot.heights);
  const wanted = [first, "mean", "p95", "max"].filter((name, i, all) => names.includes(name) && all.indexOf(name) === i);
  return (wanted.length > 0 ? wanted : names).slice(0, 3);
}

export interface ProfileOptions {
  plot: Plot;
  points: SidePoint[];
  grounds: Grounds;
  height: string; // of the page's choice
  noise: number; // of ground returns about the ground, metres
}

// Points within the noise of the ground are the ground's own.
const isGround = (point: SidePoint, noise: number): boolean => Math.abs(point.above) <= 2.5 * noise;

function dots(points: SidePoint[], x: (v: number) => number, y: (v: number) => number): string {
  return points.map((point) => `M${x(point.along).toFixed(1)} ${y(point.z).toFixed(1)}h0`).join("");
}

export function drawProfile({ plot, points, grounds, height, noise }: ProfileOptions, theme: Theme, narrow: boolean): SVGSVGElement {
  const width = narrow ? 360 : 720;
  const length = plot.box[3];
  const names = profileHeights(plot, height);
  const middle = (surface?: { height(x: number, y: number): number }) => surface?.height(plot.box[0], plot.box[1]) ?? NaN;
  const base = [middle(grounds.ground), middle(grounds.terrain)].find(Number.isFinite) ?? Math.min(...points.map((point) => point.z), 0);
  const shown = points.length <= kMostPoints ? points : points.filter((_, i) => (i * kMostPoints) % points.length < kMostPoints);
  const sorted = shown.map((point) => point.z).sort((a, b) => a - b);
  const tops = names.map((name) => base + (plot.heights[name][3] ?? plot.heights[name][0]));
  const low = Math.min(sorted[Math.floor(sorted.length * 0.001)] ?? base, base - 0.05);
  const high = Math.max(sorted[Math.floor(sorted.length * 0.999)] ?? base, ...tops, base + 0.2);
  const margin = 0.06 * (high - low);
  const kinds: [string, string, SidePoint[]][] = [
    ["beyond the plot's ends", theme.dark ? "#6e7681" : "#b6bdc5", shown.filter((point) => !point.inside)],
    ["crop", theme.kinds[2], shown.filter((point) => point.inside && !isGround(point, noise))],
    ["within the ground's noise", theme.dark ? "#d6a461" : "#a1762f", shown.filter((point) => point.inside && isGround(point, noise))],
  ];
  const ground = grounds.ground ? groundLine(plot.box, (u, v) => grounds.ground!.height(u, v)) : [];
  const terrain = grounds.terrain ? groundLine(plot.box, (u, v) => grounds.terrain!.height(u, v)) : [];
  const named: LegendEntry[] = kinds.filter(([, , some]) => some.length > 0).map(([name, colour]) => ({ name, colour, shape: 0 }));
  if (ground.length) named.push({ name: "fitted ground ± 1.96 SE", colour: theme.ink, dash: "" });
  if (narrow) names.forEach((name, i) => named.push({ name, colour: theme.kinds[kHeightKinds[i]], dash: "" }));
  if (terrain.length) named.push({ name: "true ground", colour: theme.kinds[5], dash: "5 3" });
  if (names.some((name) => plot.truths[namedTruth(name)] !== undefined)) named.push({ name: "truth", colour: theme.soft, dash: "2 3" });
  const top = 14 + legendHeight(named, width - 58);
  const total = top + 300;
  const svg = canvas(width, total, theme, `Plot ${plot.id} from the side`);
  legend(svg, named, 48, 16, width - 58);
  const panel = { left: 48, top, width: width - 48 - (names.length && !narrow ? 176 : 12), height: 258 };
  const { x, y, group } = frame(svg, panel,
    { low: -kBeyond, high: length + kBeyond, label: "along the plot, m" },
    { low: low - margin, high: high + margin, label: "height z, m" }, theme);
  for (const [, colour, some] of kinds)
    if (some.length) group.append(s("path", { d: dots(some, x, y), stroke: colour, "stroke-width": 1.7, "stroke-linecap": "round", fill: "none", "stroke-opacity": 0.75 }));
  for (const end of [0, length]) group.append(line(x(end), panel.top, x(end), panel.top + panel.height, theme.soft, 1, "2 3"));
  const path = (piece: [number, number][], up = 0) => piece.map(([u, v], i) => `${i ? "L" : "M"}${round(x(u))} ${round(y(v + up))}`).join("");
  const error = (along: number): number => {
    const angle = (plot.box[4] * Math.PI) / 180;
    const from = along - length / 2;
    return 1.96 * (grounds.ground?.standardError(plot.box[0] + from * Math.cos(angle), plot.box[1] + from * Math.sin(angle)) || 0);
  };
  for (const piece of ground) {
    const band = [...piece.map(([u, v]) => [u, v + error(u)]), ...piece.map(([u, v]) => [u, v - error(u)]).reverse()] as [number, number][];
    group.append(s("path", { d: path(band) + "z", fill: theme.ink, "fill-opacity": 0.22 }), s("path", { d: path(piece), stroke: theme.ink, "stroke-width": 1.6, fill: "none" }));
  }
  for (const piece of terrain) group.append(s("path", { d: path(piece), stroke: theme.kinds[5], "stroke-width": 1.4, "stroke-dasharray": "5 3", fill: "none" }));
  const inBox = (ground.length ? ground : terrain.length ? terrain : [[[0, base], [length, base]] as [number, number][]])
    .map((piece) => piece.filter(([u]) => u >= 0 && u <= length)).filter((piece) => piece.length > 1);
  const labels: { y: number; words: string; colour: string }[] = [];
  names.forEach((name, i) => {
    const [value, , from, to] = plot.heights[name];
    const colour = theme.kinds[kHeightKinds[i]];
    for (const piece of inBox) {
      if (from !== null && to !== null) {
        const band = [...piece.map(([u, v]) => [u, v + to]), ...piece.map(([u, v]) => [u, v + from]).reverse()] as [number, number][];
        group.append(s("path", { d: path(band) + "z", fill: colour, "fill-opacity": 0.2 }));
      }
      group.append(s("path", { d: path(piece, value), stroke: colour, "stroke-width": 2, fill: "none" }));
    }
    const interval = from !== null && to !== null ? ` [${fixed(from, 3)}, ${fixed(to, 3)}]` : "";
    const end = inBox[inBox.length - 1]?.at(-1)?.[1] ?? base;
    labels.push({ y: y(end + value), words: `${name} ${fixed(value, 3)} m${interval}`, colour });
    const truth = plot.truths[namedTruth(name)];
    if (truth !== undefined && truth !== null)
      for (const piece of terrain.length ? terrain.map((all) => all.filter(([u]) => u >= 0 && u <= length)).filter((all) => all.length > 1) : inBox)
        group.append(s("path", { d: path(piece, truth), stroke: colour, "stroke-width": 1.5, "stroke-dasharray": "2 3", fill: "none" }));
  });
  // Labels beside the ends of their lines, none over another.
  labels.sort((a, b) => a.y - b.y);
  if (!narrow) labels.forEach((label, i) => {
    if (i > 0) label.y = Math.max(label.y, labels[i - 1].y + 26);
    const [name, rest] = [label.words.split(" [")[0], label.words.split(" [")[1]];
    const left = panel.left + panel.width + 8;
    svg.append(text(left, label.y + 1, name, { colour: label.colour, bold: true }));
    if (rest) svg.append(text(left, label.y + 13, `95 %: [${rest}`, { colour: theme.soft, size: 10 }));
  });
  const factor = panel.height / (high - low + 2 * margin) / (panel.width / (length + 2 * kBeyond));
  svg.append(text(width - 8, total - 11 + (narrow ? 9 : 0), `heights drawn × ${fixed(factor, 1)}`, { anchor: "end", colour: theme.soft, size: 10 }));
  return svg;
}

export function profileCsv({ plot, points, noise }: ProfileOptions): string {
  return csv([
    ["plot", "along_m", "z_m", "above_ground_m", "kind"],
    ...points.map((point) => [plot.id, fixedNumber(point.along), fixedNumber(point.z), fixedNumber(point.above),
      point.inside ? (isGround(point, noise) ? "ground" : "crop") : "beyond"]),
  ]);
}

const fixedNumber = (value: number): number => Math.round(value * 1e4) / 1e4;
