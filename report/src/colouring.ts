// What the points of a cloud are coloured by.
import { axesOf } from "./boxes";
import type { Colouring } from "./cloud";
import { classColours, classNames, cividis, heightRamp, hex, noPlot, plasma, plotColour, viridis, type Ramp, type Rgb } from "./colours";
import type { Field } from "./data";
import type { TilePoints } from "./decode";
import { quantile } from "./numbers";
import type { Grounds } from "./place";

export type Mode = "height" | "elevation" | "class" | "plot" | "intensity" | "time";

export interface Key {
  // A ramp from low to high, or names of colours.
  ramp?: { low: number; high: number; css: string; unit: string; title: string };
  kinds?: { name: string; colour: string }[];
}

export interface Look {
  colouring: Colouring;
  key: Key;
}

export function modesOf(field: Field, grounds: Grounds): { value: Mode; label: string }[] {
  const has = field.cloud?.has ?? [];
  const modes: { value: Mode; label: string }[] = [];
  if (grounds.ground ?? grounds.terrain) modes.push({ value: "height", label: "height above ground" });
  modes.push({ value: "elevation", label: "elevation" });
  if (has.includes("class")) modes.push({ value: "class", label: "class" });
  if (has.includes("plot") || field.plots.length > 0) modes.push({ value: "plot", label: "plot" });
  if (has.includes("intensity")) modes.push({ value: "intensity", label: "intensity" });
  if (has.includes("time")) modes.push({ value: "time", label: "time" });
  return modes;
}

function colours(colour: (value: number) => Rgb): Uint8Array {
  const bytes = new Uint8Array(1024);
  for (let value = 0; value < 256; ++value) bytes.set([...colour(value).map(Math.round), 255], 4 * value);
  return bytes;
}

const css = (ramp: Ramp): string =>
  `linear-gradient(to right, ${Array.from({ length: 11 }, (_, i) => hex(ramp(i / 10))).join(", ")})`;

const byte = (share: number): number => Math.min(255, Math.max(0, Math.round(255 * share)));

// A colouring by numbers that are measured on a sample of the points first.
function amounts(
  tiles: TilePoints[], ramp: Ramp, title: string, unit: string, range: [number, number] | "sampled" | "from zero",
  number: (points: TilePoints, point: number) => number): Look {
  let [low, high] = [0, 1];
  if (typeof range === "string") {
    const sample: number[] = [];
    for (const tile of tiles)
      for (let i = 0; i < Math.min(tile.tile.n, 256); ++i) {
        const value = number(tile, i);
        if (Number.isFinite(value)) sample.push(value);
      }
    sample.sort((a, b) => a - b);
    low = range === "from zero" ? 0 : (quantile(sample, 0.005) || 0);
    high = Math.max(quantile(sample, 0.997) || 0, low + 1e-3);
  } else {
    [low, high] = range;
  }
  return {
    colouring: {
      colours: colours((value) => ramp(value / 255)),
      values: (points, put) => {
        for (let i = 0; i < points.tile.n; ++i) put(i, byte((number(points, i) - low) / (high - low)));
      },
    },
    key: { ramp: { low, high, css: css(ramp), unit, title } },
  };
}

function byClass(): Look {
  return {
    colouring: {
      colours: colours((value) => classColours[value] ?? noPlot),
      values: (points, put) => points.labels?.forEach((label, i) => put(i, label)),
    },
    key: { kinds: classNames.map((name, i) => ({ name, colour: hex(classColours[i]) })) },
  };
}

// The plot that a point's label names, or in whose box it lies.
function byPlot(field: Field): Look {
  const kBand = 254;
  const colouring: Colouring = {
    colours: colours((value) => (value === 255 ? noPlot : plotColour(value))),
    values: (points, put) => {
      const { tile, places } = points;
      if (points.plots) {
        points.plots.forEach((plot, i) => put(i, plot === 0 ? 255 : plot % kBand));
        return;
      }
      const [left, south] = [tile.low[0] + field.cloud!.origin[0], tile.low[1] + field.cloud!.origin[1]];
      const near = field.plots.map((plot, number) => ({ box: plot.box, number })).filter(({ box }) => {
        const reach = Math.hypot(box[2], box[3]) / 2;
        return box[0] + reach > left && box[1] + reach > south &&
          box[0] - reach < tile.high[0] + field.cloud!.origin[0] && box[1] - reach < tile.high[1] + field.cloud!.origin[1];
      }).map(({ box, number }) => ({ box, number, axes: axesOf(box) }));
      for (let i = 0; i < tile.n; ++i) {
        const x = left + tile.step * places[4 * i];
        const y = south + tile.step * places[4 * i + 1];
        const inside = near.find(({ box, axes }) => Math.abs(axes.along(x, y)) <= box[3] / 2 && Math.abs(axes.across(x, y)) <= box[2] / 2);
        put(i, inside ? inside.number % kBand : 255);
      }
    },
  };
  return { colouring, key: { kinds: [{ name: "neighbouring plots differ", colour: hex(plotColour(0)) }, { name: "no plot", colour: hex(noPlot) }] } };
}

export function lookOf(mode: Mode, field: Field, grounds: Grounds, tiles: TilePoints[]): Look {
  const cloud = field.cloud!;
  const z = ({ tile, places }: TilePoints, i: number) => tile.low[2] + cloud.origin[2] + tile.step * places[4 * i + 2];
  switch (mode) {
    case "height": {
      const surface = (grounds.ground ?? grounds.terrain)!;
      return amounts(tiles, heightRamp, "height above ground", "m", "from zero", (points, i) => z(points, i) - surface.height(
        points.tile.low[0] + cloud.origin[0] + points.tile.step * points.places[4 * i],
        points.tile.low[1] + cloud.origin[1] + points.tile.step * points.places[4 * i + 1]));
    }
    case "elevation": return amounts(tiles, viridis, "elevation z", "m", "sampled", z);
    case "class": return byClass();
    case "plot": return byPlot(field);
    case "intensity": return amounts(tiles, cividis, "intensity", "", "sampled", (points, i) => points.intensities![i]);
    case "time": {
      const [first, last] = cloud.time;
      return amounts(tiles, plasma, "time", "s", [first, last], (points, i) => first + ((last - first) * points.times![i]) / 255);
    }
  }
}
