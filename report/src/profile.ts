// A plot from the side: its points, the ground, heights with their intervals, truths.
import { canvas, frame, legend, legendHeight, line, round, text, type Frame, type LegendEntry, type Panel } from "./axes";
import type { Theme } from "./colours";
import type { Box, Cloud, Plot } from "./data";
import type { Surface, TilePoints } from "./decode";
import { s } from "./dom";
import { csv, fixed, namedTruth, quantile } from "./numbers";
import type { Grounds } from "./place";

export const kBeyond = 1; // metres that are shown before and behind the plot
const kMostPoints = 9000;

// A fair share of the points where they are many.
export const fewOf = <Point>(points: Point[], most = kMostPoints): Point[] =>
  points.length <= most ? points : points.filter((_, i) => (i * most) % points.length < most);

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
  return pointsOver(plot.box, cloud, tiles, (x, y) => grounds.ground?.height(x, y) ?? NaN);
}

// The same of any box, over any ground.
export function pointsOver([x0, y0, width, length, heading]: Box, cloud: Cloud, tiles: TilePoints[], ground: (x: number, y: number) => number): SidePoint[] {
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
        along: along + length / 2, z, above: z - ground(x + x0, y + y0),
        inside: Math.abs(along) <= length / 2,
      });
    }
  }
  return found;
}

// A line of ground along the plot's middle, in pieces without gaps.
export function groundLine(box: Box, height: (x: number, y: number) => number): [number, number][][] {
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

type Line = [number, number][]; // places along the plot and up

interface Side {
  frame: Frame;
  theme: Theme;
  panel: Panel;
}

const pathOn = ({ frame: { x, y } }: Side, piece: Line, up = 0): string =>
  piece.map(([u, v], i) => `${i ? "L" : "M"}${round(x(u))} ${round(y(v + up))}`).join("");

const stroke = (side: Side, piece: Line, colour: string, width: number, up = 0, dash?: string): void =>
  side.frame.group.append(s("path", { d: pathOn(side, piece, up), stroke: colour, "stroke-width": width, "stroke-dasharray": dash, fill: "none" }));

// What lies between two lines of as many places.
const band = (side: Side, low: Line, high: Line, colour: string, opacity: number): void =>
  side.frame.group.append(s("path", { d: `${pathOn(side, [...high, ...[...low].reverse()])}z`, fill: colour, "fill-opacity": opacity }));

interface Kind {
  name: string;
  colour: string;
  points: SidePoint[];
}

function kindsOf(points: SidePoint[], noise: number, theme: Theme): Kind[] {
  const inside = points.filter((point) => point.inside);
  return [
    { name: "beyond the plot's ends", colour: theme.dark ? "#6e7681" : "#b6bdc5", points: points.filter((point) => !point.inside) },
    { name: "crop", colour: theme.kinds[2], points: inside.filter((point) => !isGround(point, noise)) },
    { name: "within the ground's noise", colour: theme.dark ? "#d6a461" : "#a1762f", points: inside.filter((point) => isGround(point, noise)) },
  ].filter((kind) => kind.points.length > 0);
}

// One path of dots: thousands of circles would be slow.
function drawDots(side: Side, { colour, points }: Kind): void {
  const { x, y } = side.frame;
  const d = points.map((point) => `M${x(point.along).toFixed(1)} ${y(point.z).toFixed(1)}h0`).join("");
  side.frame.group.append(s("path", { d, stroke: colour, "stroke-width": 1.7, "stroke-linecap": "round", fill: "none", "stroke-opacity": 0.75 }));
}

function drawGround(side: Side, plot: Plot, grounds: Grounds, ground: Line[], terrain: Line[]): void {
  const { theme } = side;
  const angle = (plot.box[4] * Math.PI) / 180;
  const error = (along: number): number => {
    const from = along - plot.box[3] / 2;
    return 1.96 * (grounds.ground?.standardError(plot.box[0] + from * Math.cos(angle), plot.box[1] + from * Math.sin(angle)) || 0);
  };
  for (const piece of ground) {
    band(side, piece.map(([u, v]) => [u, v - error(u)]), piece.map(([u, v]) => [u, v + error(u)]), theme.ink, 0.22);
    stroke(side, piece, theme.ink, 1.6);
  }
  for (const piece of terrain) stroke(side, piece, theme.kinds[5], 1.4, 0, "5 3");
}

// A height over the ground with its interval, and its truth; where the line ends.
function drawHeight(side: Side, plot: Plot, name: string, colour: string, over: { ground: Line[]; terrain: Line[] }): number {
  const [value, , low, high] = plot.heights[name];
  for (const piece of over.ground) {
    if (low !== null && high !== null)
      band(side, piece.map(([u, v]) => [u, v + low]), piece.map(([u, v]) => [u, v + high]), colour, 0.2);
    stroke(side, piece, colour, 2, value);
  }
  const truth = plot.truths[namedTruth(name)];
  if (truth !== undefined && truth !== null)
    for (const piece of over.terrain) stroke(side, piece, colour, 1.5, truth, "2 3");
  return side.frame.y((over.ground.at(-1)?.at(-1)?.[1] ?? 0) + value);
}

// Names of the heights beside the ends of their lines, none over another.
function drawLabels(svg: SVGSVGElement, { panel, theme }: Side, plot: Plot, labels: { name: string; y: number; colour: string }[]): void {
  const left = panel.left + panel.width + 8;
  let last = -Infinity;
  for (const { name, y, colour } of [...labels].sort((a, b) => a.y - b.y)) {
    last = Math.max(y, last + 26);
    const [value, , low, high] = plot.heights[name];
    svg.append(text(left, last + 1, `${name} ${fixed(value, 3)} m`, { colour, bold: true }));
    if (low !== null) svg.append(text(left, last + 13, `95 %: [${fixed(low, 3)}, ${fixed(high, 3)}]`, { colour: theme.soft, size: 10 }));
  }
}

// What heights stand on: the ground in the plot's middle; where none is known, the low end of its points.
export function baseOf(plot: Plot, points: SidePoint[], grounds: Grounds): number {
  for (const surface of [grounds.ground, grounds.terrain]) {
    const z = surface?.height(plot.box[0], plot.box[1]) ?? NaN;
    if (Number.isFinite(z)) return z;
  }
  return quantile(points.map((point) => point.z).sort((a, b) => a - b), 0.01) || 0;
}

// The range of z that is shown: nearly all points, and the heights.
function rangeOf(plot: Plot, points: SidePoint[], names: string[], base: number): [number, number] {
  const sorted = points.map((point) => point.z).sort((a, b) => a - b);
  const tops = names.map((name) => base + (plot.heights[name][3] ?? plot.heights[name][0]));
  const low = Math.min(sorted[Math.floor(sorted.length * 0.001)] ?? base, base - 0.05);
  const high = Math.max(sorted[Math.floor(sorted.length * 0.999)] ?? base, ...tops, base + 0.2);
  const margin = 0.06 * (high - low);
  return [low - margin, high + margin];
}

export function drawProfile({ plot, points, grounds, height, noise }: ProfileOptions, theme: Theme, narrow: boolean): SVGSVGElement {
  const width = narrow ? 360 : 720;
  const length = plot.box[3];
  const names = profileHeights(plot, height);
  const shown = fewOf(points);
  const kinds = kindsOf(shown, noise, theme);
  const lineOf = (surface?: Surface) => (surface ? groundLine(plot.box, (u, v) => surface.height(u, v)) : []);
  const [ground, terrain] = [lineOf(grounds.ground), lineOf(grounds.terrain)];
  const entries: LegendEntry[] = kinds.map(({ name, colour }) => ({ name, colour, shape: 0 }));
  if (ground.length) entries.push({ name: "fitted ground ± 1.96 SE", colour: theme.ink, dash: "" });
  if (narrow) names.forEach((name, i) => entries.push({ name, colour: theme.kinds[kHeightKinds[i]], dash: "" }));
  if (terrain.length) entries.push({ name: "true ground", colour: theme.kinds[5], dash: "5 3" });
  if (names.some((name) => plot.truths[namedTruth(name)] !== undefined)) entries.push({ name: "truth", colour: theme.soft, dash: "2 3" });
  const top = 14 + legendHeight(entries, width - 66);
  const svg = canvas(width, top + 300, theme, `Plot ${plot.id} from the side`);
  legend(svg, entries, 56, 16, width - 66);
  const panel = { left: 56, top, width: width - 56 - (names.length && !narrow ? 176 : 12), height: 258 };
  const base = baseOf(plot, shown, grounds);
  const [low, high] = rangeOf(plot, shown, names, base);
  const side: Side = { theme, panel, frame: frame(svg, panel,
    { low: -kBeyond, high: length + kBeyond, label: "along the plot, m" }, { low, high, label: "height z, m" }, theme) };
  for (const kind of kinds) drawDots(side, kind);
  for (const end of [0, length]) side.frame.group.append(line(side.frame.x(end), panel.top, side.frame.x(end), panel.top + panel.height, theme.soft, 1, "2 3"));
  drawGround(side, plot, grounds, ground, terrain);
  const inBox = (pieces: Line[]) => pieces.map((piece) => piece.filter(([u]) => u >= 0 && u <= length)).filter((piece) => piece.length > 1);
  const flat: Line[] = [[[0, base], [length, base]]];
  const over = { ground: inBox([ground, terrain, flat].find((pieces) => pieces.length)!), terrain: inBox([terrain, ground, flat].find((pieces) => pieces.length)!) };
  const labels = names.map((name, i) => {
    const colour = theme.kinds[kHeightKinds[i]];
    return { name, colour, y: drawHeight(side, plot, name, colour, over) };
  });
  if (!narrow) drawLabels(svg, side, plot, labels);
  const factor = panel.height / (high - low) / (panel.width / (length + 2 * kBeyond));
  svg.append(text(width - 8, top + 289 + (narrow ? 9 : 0), `heights drawn × ${fixed(factor, 1)}`, { anchor: "end", colour: theme.soft, size: 10 }));
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
