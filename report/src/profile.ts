// A plot from the side: its points, the ground, heights with their intervals, truths.
import { canvas, dots, frame, legend, legendHeight, line, text, through, type Frame, type LegendEntry, type Panel } from "./axes";
import { axesOf } from "./boxes";
import type { Theme } from "./colours";
import type { Box, Cloud, Field, Plane, Plot } from "./data";
import type { Surface, TilePoints } from "./decode";
import { s } from "./dom";
import { measured } from "./map";
import { counted, csv, fixed, quantile } from "./numbers";
import type { Grounds } from "./place";

export const kBeyond = 1; // metres that are shown before and behind the plot
const kMostPoints = 9000;
const kNear_m = 0.075; // of the ground: what lies there may be the ground's own

// A fair share of the points where they are many.
export const fewOf = <Point>(points: Point[], most = kMostPoints): Point[] =>
  points.length <= most ? points : points.filter((_, i) => (i * most) % points.length < most);

// A point beside the plot's middle: along its length from the box's start, across, up.
export interface SidePoint {
  along: number;
  z: number;
  above: number; // the ground; NaN where none is known
  inside: boolean; // the box, not beyond its ends
}

// What a plot's heights stand on.
export interface Ground {
  name: string;
  height: (x: number, y: number) => number;
  standardError?: (x: number, y: number) => number;
}

export const planeHeight = ({ box, z, slope }: Plane) => (x: number, y: number): number => z + slope[0] * (x - box[0]) + slope[1] * (y - box[1]);

// The fitted ground, else the plane that the method took for the plot's.
export function groundUnder({ box }: Plot, { workings = [] }: Field, { ground }: Grounds): Ground | undefined {
  if (ground) return { name: "fitted ground", height: (x, y) => ground.height(x, y), standardError: ground.se && ((x, y) => ground.standardError(x, y)) };
  const plane = workings.flatMap(({ planes }) => planes).find((one) => one.box.every((value, i) => value === box[i]));
  return plane && { name: "the method's plane", height: planeHeight(plane) };
}

// The points between a box's long sides.
export function pointsOver(box: Box, cloud: Cloud, tiles: TilePoints[], ground: (x: number, y: number) => number): SidePoint[] {
  const [x0, y0, width, length] = box;
  const axes = axesOf(box);
  const reach = Math.hypot(width, length + 2 * kBeyond) / 2;
  const found: SidePoint[] = [];
  for (const { tile, places } of tiles) {
    const left = tile.low[0] + cloud.origin[0];
    const south = tile.low[1] + cloud.origin[1];
    if (left > x0 + reach || south > y0 + reach) continue;
    if (tile.high[0] + cloud.origin[0] < x0 - reach || tile.high[1] + cloud.origin[1] < y0 - reach) continue;
    const up = tile.low[2] + cloud.origin[2];
    for (let i = 0; i < tile.n; ++i) {
      const x = left + tile.step * places[4 * i];
      const y = south + tile.step * places[4 * i + 1];
      const along = axes.along(x, y);
      if (Math.abs(axes.across(x, y)) > width / 2 || Math.abs(along) > length / 2 + kBeyond) continue;
      const z = up + tile.step * places[4 * i + 2];
      found.push({ along: along + length / 2, z, above: z - ground(x, y), inside: Math.abs(along) <= length / 2 });
    }
  }
  return found;
}

// A line of ground along the plot's middle, in pieces without gaps.
export function groundLine(box: Box, height: (x: number, y: number) => number): [number, number][][] {
  const length = box[3];
  const { at } = axesOf(box);
  const pieces: [number, number][][] = [[]];
  const steps = 120;
  for (let i = 0; i <= steps; ++i) {
    const along = -kBeyond + ((length + 2 * kBeyond) * i) / steps;
    const z = height(...at(along - length / 2, 0));
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
  ground?: Ground;
  terrain?: Surface; // the true ground
  height: string; // of the page's choice
  kinds: Map<string, number>; // the heights' colours
}

// What the figure shows, in words.
export function profileNote({ plot, points, ground, terrain, height }: ProfileOptions): string {
  const names = profileHeights(plot, height);
  const inside = points.filter((point) => point.inside).length;
  const bands = names.some((name) => Number.isFinite(measured(plot, "interval", name))) ? ", bands their 95 % intervals" : "";
  const known = ground !== undefined || terrain !== undefined;
  const lines = known ? "Lines over the ground along its middle are heights" : `Lines are heights above ${points.length ? "the low end of these points" : "0"}`;
  return "Seen along the plot's width" + (points.length ? `; ${counted(inside)} points of this page between its long sides.` : ".") +
    (names.length ? ` ${lines}${bands}${known ? "" : "; no ground is known"}.` : "");
}

type Line = [number, number][]; // places along the plot and up

interface Side {
  frame: Frame;
  theme: Theme;
  panel: Panel;
}

const pathOn = ({ frame: { x, y } }: Side, piece: Line, up = 0): string => through(piece.map(([u, v]) => [x(u), y(v + up)]));

const stroke = (side: Side, piece: Line, colour: string, width: number, up = 0, dash?: string): void =>
  side.frame.group.append(s("path", { d: pathOn(side, piece, up), stroke: colour, "stroke-width": width, "stroke-dasharray": dash, fill: "none" }));

// What lies between two lines of as many places.
const band = (side: Side, low: Line, high: Line, colour: string, opacity: number): void =>
  side.frame.group.append(s("path", { d: `${pathOn(side, [...high, ...[...low].reverse()])}z`, fill: colour, "fill-opacity": opacity }));

type Kind = "beyond" | "unknown" | "ground" | "crop";

function kindOf({ inside, above }: SidePoint): Kind {
  if (!inside) return "beyond";
  if (Number.isNaN(above)) return "unknown";
  return Math.abs(above) <= kNear_m ? "ground" : "crop";
}

// The kinds of points that there are.
function kindsOf(points: SidePoint[], theme: Theme): { name: string; colour: string; points: SidePoint[] }[] {
  const kinds: [Kind, string, string][] = [
    ["beyond", "beyond the plot's ends", theme.dark ? "#6e7681" : "#b6bdc5"], ["unknown", "over no known ground", theme.kinds[2]],
    ["crop", "crop", theme.kinds[2]], ["ground", `within ${fixed(100 * kNear_m, 1)} cm of the ground`, theme.soil]];
  return kinds.map(([kind, name, colour]) => ({ name, colour, points: points.filter((point) => kindOf(point) === kind) }))
    .filter((kind) => kind.points.length > 0);
}

function drawGround(side: Side, { box }: Plot, ground: Ground, pieces: Line[]): void {
  const { at } = axesOf(box);
  const error = (along: number): number => 1.96 * (ground.standardError?.(...at(along - box[3] / 2, 0)) || 0);
  for (const piece of pieces) {
    if (ground.standardError) band(side, piece.map(([u, v]) => [u, v - error(u)]), piece.map(([u, v]) => [u, v + error(u)]), side.theme.ink, 0.22);
    stroke(side, piece, side.theme.ink, 1.6);
  }
}

// A height over the ground with its interval, and its truth; where the line ends.
function drawHeight(side: Side, plot: Plot, name: string, colour: string, over: { ground: Line[]; terrain: Line[] }): number {
  const [value, , low, high] = plot.heights[name];
  for (const piece of over.ground) {
    if (low !== null && high !== null)
      band(side, piece.map(([u, v]) => [u, v + low]), piece.map(([u, v]) => [u, v + high]), colour, 0.2);
    stroke(side, piece, colour, 2, value);
  }
  const truth = measured(plot, "truth", name);
  if (Number.isFinite(truth))
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
export function baseOf(plot: Plot, points: SidePoint[], grounds: (Pick<Ground, "height"> | undefined)[]): number {
  for (const surface of grounds) {
    const z = surface?.height(plot.box[0], plot.box[1]) ?? NaN;
    if (Number.isFinite(z)) return z;
  }
  return quantile(points.map((point) => point.z).sort((a, b) => a - b), 0.01) || 0;
}

// The range of z that is shown: nearly all points, and the heights and truths over the ground's highest place.
function rangeOf(plot: Plot, points: SidePoint[], names: string[], base: number, peak: number): [number, number] {
  const sorted = points.map((point) => point.z).sort((a, b) => a - b);
  const tops = names.map((name) => peak + Math.max(plot.heights[name][3] ?? plot.heights[name][0], measured(plot, "truth", name) || 0));
  const low = Math.min(sorted[Math.floor(sorted.length * 0.001)] ?? base, base - 0.05);
  const high = Math.max(sorted[Math.floor(sorted.length * 0.999)] ?? base, ...tops, base + 0.2);
  const margin = 0.06 * (high - low);
  return [low - margin, high + margin];
}

export function drawProfile({ plot, points, ground, terrain, height, kinds }: ProfileOptions, theme: Theme, narrow: boolean): SVGSVGElement {
  const width = narrow ? 360 : 720;
  const length = plot.box[3];
  const names = profileHeights(plot, height);
  const colourOf = (name: string): string => theme.kinds[kinds.get(name)!];
  const shown = fewOf(points);
  const seen = kindsOf(shown, theme);
  const lineOf = (under?: Pick<Ground, "height">): Line[] => (under ? groundLine(plot.box, (u, v) => under.height(u, v)) : []);
  const [own, known] = [lineOf(ground), lineOf(terrain)];
  const entries: LegendEntry[] = seen.map(({ name, colour }) => ({ name, colour, shape: 0 }));
  if (own.length) entries.push({ name: ground!.name + (ground!.standardError ? " ± 1.96 SE" : ""), colour: theme.ink, dash: "" });
  if (narrow) names.forEach((name) => entries.push({ name, colour: colourOf(name), dash: "" }));
  if (known.length) entries.push({ name: "true ground", colour: theme.kinds[5], dash: "5 3" });
  if (names.some((name) => Number.isFinite(measured(plot, "truth", name)))) entries.push({ name: "truth", colour: theme.soft, dash: "2 3" });
  const top = 14 + legendHeight(entries, width - 66);
  const svg = canvas(width, top + 300, theme, `Plot ${plot.id} from the side`);
  legend(svg, entries, 56, 16, width - 66);
  const panel = { left: 56, top, width: width - 56 - (names.length && !narrow ? 176 : 12), height: 258 };
  const base = baseOf(plot, shown, [ground, terrain]);
  const inBox = (pieces: Line[]) => pieces.map((piece) => piece.filter(([u]) => u >= 0 && u <= length)).filter((piece) => piece.length > 1);
  const flat: Line[] = [[[0, base], [length, base]]];
  const over = { ground: inBox([own, known, flat].find((pieces) => pieces.length)!), terrain: inBox([known, own, flat].find((pieces) => pieces.length)!) };
  const [low, high] = rangeOf(plot, shown, names, base, Math.max(base, ...[...over.ground, ...over.terrain].flat().map(([, z]) => z)));
  const side: Side = { theme, panel, frame: frame(svg, panel,
    { low: -kBeyond, high: length + kBeyond, label: "along the plot, m" }, { low, high, label: "height z, m" }, theme) };
  const { x, y, group } = side.frame;
  for (const { points, colour } of seen) group.append(dots(points.map(({ along, z }) => [x(along), y(z)]), colour, 1.7, 0.75));
  for (const end of [0, length]) group.append(line(x(end), panel.top, x(end), panel.top + panel.height, theme.soft, 1, "2 3"));
  if (ground) drawGround(side, plot, ground, own);
  for (const piece of known) stroke(side, piece, theme.kinds[5], 1.4, 0, "5 3");
  const labels = names.map((name) => ({ name, colour: colourOf(name), y: drawHeight(side, plot, name, colourOf(name), over) }));
  if (!narrow) drawLabels(svg, side, plot, labels);
  const factor = panel.height / (high - low) / (panel.width / (length + 2 * kBeyond));
  svg.append(text(width - 8, top + 289 + (narrow ? 9 : 0), `heights drawn × ${fixed(factor, 1)}`, { anchor: "end", colour: theme.soft, size: 10 }));
  return svg;
}

export function profileCsv({ plot, points }: ProfileOptions): string {
  return csv([
    ["plot", "along_m", "z_m", "above_ground_m", "kind"],
    ...points.map((point) => [plot.id, fixedNumber(point.along), fixedNumber(point.z), fixedNumber(point.above), kindOf(point)]),
  ]);
}

const fixedNumber = (value: number): number => Math.round(value * 1e4) / 1e4;
