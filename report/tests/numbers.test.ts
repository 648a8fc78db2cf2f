import { describe, expect, it } from "vitest";
import { tickTexts } from "../src/axes";
import { corners } from "../src/boxes";
import type { Field, Plot } from "../src/data";
import { coloursOf } from "../src/map";
import { csv, extremes, fixed, namedTruth, quantile, signed, ticks } from "../src/numbers";
import { fileName } from "../src/save";
import { Place } from "../src/place";
import { baseOf } from "../src/profile";

describe("numbers", () => {
  it("are written with a true minus, and absence as a dash", () => {
    expect(fixed(-0.126, 2)).toBe("−0.13");
    expect(fixed(-0.001, 2)).toBe("0.00");
    expect(signed(0.26, 1)).toBe("+0.3");
    expect(signed(0.01, 1)).toBe("0.0");
    for (const none of [null, undefined, NaN]) expect(fixed(none, 2)).toBe("–");
  });

  it("have round ticks inside the range", () => {
    expect(ticks(0, 10)).toEqual([0, 2, 4, 6, 8, 10]);
    expect(ticks(-0.13, 0.13)).toEqual([-0.1, -0.05, 0, 0.05, 0.1]);
    for (const [low, high] of [[0.91, 0.96], [-3, 1000], [1e-6, 3e-6]])
      for (const tick of ticks(low, high)) expect(tick >= low - 1e-9 && tick <= high + 1e-9).toBe(true);
    expect(ticks(1, 1)).toEqual([1]);
  });

  it("stand at their ticks with the decimals that tell them apart, beyond where they count from", () => {
    expect(tickTexts(0, 2.4)).toEqual([[0, "0.0"], [0.5, "0.5"], [1, "1.0"], [1.5, "1.5"], [2, "2.0"]]);
    expect(tickTexts(500_001, 500_005.5, { from: 500_000 }).map(([, words]) => words)).toEqual(["1", "2", "3", "4", "5"]);
  });

  it("have extremes, however many they are", () => {
    const many = Array.from({ length: 300_000 }, (_, i) => (i % 1000) - 1);
    expect(extremes(many, [0, 1])).toEqual([-1, 998]);
    expect(extremes([], [0, 1])).toEqual([0, 1]);
    expect(coloursOf(many, "height")).toMatchObject({ low: -1, high: 998 });
  });

  it("have quantiles linear between order statistics", () => {
    expect(quantile([1, 2, 3, 4], 0.5)).toBe(2.5);
    expect(quantile([], 0.5)).toBeNaN();
  });

  it("go into CSV as RFC 4180 has it", () => {
    expect(csv([["a", 1, NaN, null], ['say "x", y', -2, undefined, "line\nbreak"]])).toBe(
      'a,1,,\r\n"say ""x"", y",-2,,"line\nbreak"\r\n');
    expect(csv([[0.1 + 0.2, 4511999.12345, -1e-12, 1e9]])).toBe("0.3,4511999.12345,0,1000000000\r\n");
  });

  it("know the truth that a height is named after", () => {
    expect(namedTruth("max")).toBe("height_max_m");
    expect(namedTruth("canopy_p95")).toBe("canopy_p95_m");
  });
});

describe("names and places", () => {
  it("makes file names that every system takes", () => {
    expect(fileName("Plot \"><img src=x> from the side", "svg")).toBe("plot-img-src-x-from-the-side.svg");
    expect(fileName("<<>>", "csv")).toBe("plotscan.csv");
  });

  it("has a box's corners counter-clockwise, its length along the heading", () => {
    const [a, b, c, d] = corners([10, 20, 2, 6, 90]).map((corner) => corner.map((value) => Math.round(1e9 * value) / 1e9));
    expect([a, b, c, d]).toEqual([[11, 17], [11, 23], [9, 23], [9, 17]]);
  });
});

// A plot at 300 m above sea level, on a page without any ground.
describe("a field without a ground", () => {
  const plot: Plot = { id: "1", row: 0, column: 0, box: [5, 5, 2, 4, 0], heights: {}, flags: [], truths: {}, state: "" };
  const tile = { n: 1, at: 0, bytes: 0, low: [0, 0, -0.1] as [number, number, number], high: [10, 10, 1] as [number, number, number], step: 0.004 };
  const field: Field = {
    name: "field", facts: [], notes: [], path: [], plots: [plot], true_boxes: [],
    cloud: { read: 1, shown: 1, origin: [0, 0, 300], time: [0, 0], has: [], tiles: [tile, { ...tile, low: [0, 0, -40] }, tile], data: { blob: 0 } },
  };

  it("lies as high as its points", () => {
    expect(new Place(field, {}).groundAt(5, 5)).toBeCloseTo(299.9, 9);
    expect(new Place({ ...field, cloud: undefined }, {}).groundAt(5, 5)).toBe(0);
  });

  it("has heights that stand on the low end of the plot's points", () => {
    const points = Array.from({ length: 101 }, (_, i) => ({ along: 1, z: 300 + 0.01 * i, above: NaN, inside: true }));
    expect(baseOf(plot, points, [])).toBeCloseTo(300.01, 9);
    expect(baseOf(plot, [], [])).toBe(0);
  });
});
