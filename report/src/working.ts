// How a method came to its plots, as the paper's figures show it: the boxes of clusters before the vote and of
// plots after it; the points that it took for ground.
import { canvas, dots, frame, legend, legendHeight, text, through, type LegendEntry } from "./axes";
import { axesOf } from "./boxes";
import type { Theme } from "./colours";
import type { Box, Cloud, Field, Plane, Working } from "./data";
import type { TilePoints } from "./decode";
import { s } from "./dom";
import { cornersOn, kAxis, sheetIn, type Sheet } from "./map";
import { counted, csv, fixed } from "./numbers";
import type { Grounds } from "./place";
import { fewOf, groundLine, kBeyond, planeHeight, pointsOver, type SidePoint } from "./profile";

const kCanopy_m = 0.15; // dhami2020's: what stands higher is clustered
const kMostPoints = 5000; // of a panel

export interface WorkingOptions {
  field: Field;
  working: Working;
  cloud?: Cloud;
  tiles: TilePoints[];
  grounds: Grounds;
}

// Places of points that stand above the ground, a fair share of them.
function canopyOf({ cloud, tiles, grounds }: WorkingOptions): [number, number][] {
  if (!cloud) return [];
  const ground = grounds.ground ?? grounds.terrain;
  const places: [number, number][] = [];
  const all = tiles.reduce((sum, { tile }) => sum + tile.n, 0);
  const stride = Math.max(1, Math.floor(all / (12 * kMostPoints)));
  for (const { tile, places: steps } of tiles)
    for (let i = 0; i < tile.n; i += stride) {
      const [x, y, z] = [0, 1, 2].map((axis) => tile.low[axis] + cloud.origin[axis] + tile.step * steps[4 * i + axis]);
      if (!ground || z - ground.height(x, y) > kCanopy_m) places.push([x, y]);
    }
  return fewOf(places, kMostPoints);
}

function drawBoxes(sheet: Sheet, boxes: Box[], colour: string, width: number, dash?: string): void {
  for (const box of boxes)
    sheet.svg.append(s("polygon", { points: cornersOn(sheet, box), fill: "none", stroke: colour, "stroke-width": width, "stroke-dasharray": dash }));
}

export function drawVoting(options: WorkingOptions, theme: Theme, narrow: boolean): SVGSVGElement {
  const { field, working } = options;
  const canopy = canopyOf(options);
  const truth = field.true_boxes.map(({ box }) => box);
  const columns = narrow ? 1 : 2;
  const width = narrow ? 360 : 720;
  const side = width / columns - kAxis - 6;
  const entries: LegendEntry[] = [{ name: "the method's boxes", colour: theme.kinds[1], dash: "" }];
  if (truth.length) entries.push({ name: "true plots", colour: theme.ink, dash: "3 2" });
  if (canopy.length) entries.push({ name: "points above the ground", colour: theme.kinds[2], shape: 0 });
  const top = 22 + legendHeight(entries, width - 60);
  const pitch = side + 66;
  const svg = canvas(width, top + pitch * (2 / columns) - 14, theme, `Boxes before and after voting, ${working.method}`);
  legend(svg, entries, 50, 16, width - 60);
  const parts: [string, Box[]][] = [[`(a) clusters, n = ${working.clusters.length}`, working.clusters], [`(b) after the vote, n = ${working.plots.length}`, working.plots]];
  parts.forEach(([title, boxes], i) => {
    const panel = { left: kAxis + (i % columns) * (side + kAxis + 6), top: top + pitch * Math.floor(i / columns), width: side, height: side };
    const sheet = sheetIn(svg, panel, [...truth, ...working.clusters, ...working.plots], theme);
    svg.append(text(panel.left + side / 2, panel.top - 6, title, { anchor: "middle" }));
    const places = canopy.map(([x, y]) => sheet.at(x, y)).filter(([u, v]) => u > panel.left && u < panel.left + side && v > panel.top && v < panel.top + side);
    svg.append(dots(places, theme.kinds[2], 1.2, 0.6));
    drawBoxes(sheet, truth, theme.ink, 0.9, "3 2");
    drawBoxes(sheet, boxes, theme.kinds[1], 1.6);
  });
  return svg;
}

export function votingCsv({ working }: WorkingOptions): string {
  const rows = (step: string, boxes: Box[]) => boxes.map((box) => [step, ...box]);
  return csv([["boxes", "center_x_m", "center_y_m", "width_m", "length_m", "heading_deg"],
    ...rows("before", working.clusters), ...rows("after", working.plots)]);
}

// How far the ground is from the plane under a plot, root mean square over its box.
function unevenness(plane: Plane, { terrain, ground }: Grounds): number {
  const surface = terrain ?? ground;
  if (!surface) return NaN;
  const [, , width, length] = plane.box;
  const { at } = axesOf(plane.box);
  let sum = 0;
  let n = 0;
  for (let u = -0.5; u <= 0.5; u += 0.1)
    for (let v = -0.5; v <= 0.5; v += 0.25) {
      const [x, y] = at(u * length, v * width);
      const off = surface.height(x, y) - planeHeight(plane)(x, y);
      if (Number.isFinite(off)) [sum, n] = [sum + off * off, n + 1];
    }
  return n ? Math.sqrt(sum / n) : NaN;
}

// The plots whose planes fit the ground worst and best: those of the paper's figure; else the first and last.
function twoPlanes(working: Working, grounds: Grounds): { plane: Plane; off: number }[] {
  const all = working.planes.map((plane) => ({ plane, off: unevenness(plane, grounds) }));
  if (all.every(({ off }) => Number.isFinite(off))) all.sort((a, b) => b.off - a.off);
  return all.length > 1 ? [all[0], all[all.length - 1]] : all;
}

export function inliersNote({ working, grounds }: WorkingOptions): string {
  const [first, last] = twoPlanes(working, grounds);
  const which = Number.isFinite(first.off) ? "those whose ground is farthest from and nearest to a plane" : "the first and the last";
  return `Points within ${fixed(100 * first.plane.tolerance, 0)} cm of the plane that the method took for the plot's ground, seen along the plot's width` +
    (last ? `: of ${counted(working.planes.length)} plots ${which}.` : ".");
}

interface Seen {
  plane: Plane;
  off: number;
  points: (SidePoint & { ground: boolean })[];
}

function seenOf({ working, cloud, tiles, grounds }: WorkingOptions): Seen[] {
  return twoPlanes(working, grounds).map(({ plane, off }) => {
    const points = cloud ? pointsOver(plane.box, cloud, tiles, planeHeight(plane)) : [];
    const upright = 1 / Math.hypot(1, ...plane.slope); // from vertical distance to that from the plane
    return { plane, off, points: points.map((point) => ({ ...point, ground: Math.abs(point.above) * upright <= plane.tolerance })) };
  });
}

export function drawInliers(options: WorkingOptions, theme: Theme, narrow: boolean): SVGSVGElement {
  const seen = seenOf(options);
  const columns = narrow ? 1 : 2;
  const width = narrow ? 360 : 720;
  const entries: LegendEntry[] = [{ name: "ground inliers", colour: theme.soil, shape: 0 }, { name: "outliers", colour: theme.ink, shape: 0 }, { name: "the plot's plane", colour: theme.kinds[1], dash: "" }];
  if (options.grounds.terrain) entries.push({ name: "true ground", colour: theme.kinds[5], dash: "5 3" });
  const top = 22 + legendHeight(entries, width - 60);
  const svg = canvas(width, top + 256 * Math.ceil(seen.length / columns), theme, `Ground inliers of plots, ${options.working.method}`);
  legend(svg, entries, 50, 16, width - 60);
  seen.forEach(({ plane, off, points }, i) => {
    const panel = { left: 56 + (i % columns) * (width / columns), top: top + 256 * Math.floor(i / columns), width: width / columns - 68, height: 200 };
    const shown = fewOf(points, kMostPoints);
    const heights = [...shown.map(({ z }) => z), plane.z].sort((a, b) => a - b);
    const [low, high] = [heights[Math.floor(0.002 * heights.length)], heights[Math.ceil(0.998 * heights.length) - 1]];
    const margin = 0.06 * (high - low || 1);
    const length = plane.box[3];
    const { x, y, group } = frame(svg, panel, { low: -kBeyond, high: length + kBeyond, label: "along the plot, m" }, { low: low - margin, high: high + margin, label: i % columns ? "" : "height z, m" }, theme);
    for (const [ground, colour] of [[false, theme.ink], [true, theme.soil]] as const)
      group.append(dots(shown.filter((point) => point.ground === ground).map(({ along, z }) => [x(along), y(z)]), colour, 1.6, 0.7));
    const lines: [(u: number, v: number) => number, string, string | undefined][] = [[planeHeight(plane), theme.kinds[1], undefined]];
    const { terrain } = options.grounds;
    if (terrain) lines.push([(u, v) => terrain.height(u, v), theme.kinds[5], "5 3"]);
    for (const [height, colour, dash] of lines)
      for (const piece of groundLine(plane.box, height))
        group.append(s("path", { d: through(piece.map(([u, v]) => [x(u), y(v)])), stroke: colour, "stroke-width": 1.8, "stroke-dasharray": dash, fill: "none" }));
    const inliers = points.filter(({ ground }) => ground).length;
    svg.append(text(panel.left + panel.width / 2, panel.top - 6,
      `(${"ab"[i]}) plot ${plane.id}${Number.isFinite(off) ? `, ground ${fixed(100 * off, 1)} cm from the plane (rms)` : ""}; ${counted(inliers)} of ${counted(points.length)}`, { anchor: "middle", size: 9.5 }));
  });
  return svg;
}

export function inliersCsv(options: WorkingOptions): string {
  return csv([["plot", "along_m", "z_m", "above_plane_m", "ground_inlier"],
    ...seenOf(options).flatMap(({ plane, points }) => points.map(({ along, z, above, ground }) =>
      [plane.id, ...[along, z, above].map((value) => Math.round(1e4 * value) / 1e4), ground ? 1 : 0]))]);
}
