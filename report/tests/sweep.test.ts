import { describe, expect, it } from "vitest";
import { bandOf, bands, contourLines } from "../src/contours";
import type { Suite } from "../src/data";
import { axisName, combination, flightsOf, reaches, shortest } from "../src/sweep_data";

const plane = { xs: [0, 1, 4], ys: [0, 2], values: [[0, 1, 4], [2, 3, 6]] }; // x + y

describe("contours", () => {
  it("lie where a plane has the value", () => {
    const pieces = contourLines(plane, 2.5);
    for (const [x, y] of pieces.flat()) expect(x + y).toBeCloseTo(2.5, 9);
    const length = pieces.reduce((sum, [[x0, y0], [x1, y1]]) => sum + Math.hypot(x1 - x0, y1 - y0), 0);
    expect(length).toBeCloseTo(2 * Math.SQRT2, 9); // from (0.5, 2) to (2.5, 0)
  });

  it("lie on the hyperbola of a saddle", () => {
    for (const [x, y] of contourLines({ xs: [-1, 1], ys: [-1, 1], values: [[1, -1], [-1, 1]] }, 0.25).flat())
      expect(x * y).toBeCloseTo(0.25, 2);
  });

  it("have bands between them that fill the known cells", () => {
    const area = (squares: [number, number, number, number][]) => squares.reduce((sum, [x0, y0, x1, y1]) => sum + (x1 - x0) * (y1 - y0), 0);
    const [below, above] = bands(plane, [2]).map(area);
    expect(below + above).toBeCloseTo(8, 9);
    expect(below).toBeCloseTo(2, 1); // the triangle below x + y = 2
    expect(bandOf([1, 2], 2)).toBe(2);
  });

  it("leave out what is unknown", () => {
    const holed = { ...plane, values: [[0, 1, NaN], [2, 3, 6]] };
    expect(bands(holed, []).flat().every(([, , x1]) => x1 <= 1)).toBe(true);
    expect(contourLines(holed, 4.5)).toEqual([]);
  });
});

describe("a sweep", () => {
  const row = (name: string, rmse: number | null, high: number | null, found: number) =>
    ({ case: name, method: "lattice/mean", truth: "height_mean_m", named: true, shown: true, farms: 2, plots: 10, found, rmse_m: rmse, rmse_high_m: high });
  const suite = {
    name: "mine", cases: ["a", "b", "c", "d"].map((name) => ({ name })), truths: [], farms: [], plots: {}, series: [], boxes: [],
    table: [row("a", 0.01, 0.02, 10), row("b", 0.02, 0.04, 10), row("c", 0.01, null, 9), row("d", null, null, 0)],
    sweep: {
      axes: [{ key: "altitude_m", values: [10, 20] }, { key: "sensor", values: ["x", "y"] }], height: "mean", truth: "height_mean_m", row: "lattice/mean",
      flights: [40, 30, 20, 10].map((flight_s) => ({ flight_s, points: 1 })) },
  } as Suite;

  it("combines its axes, the last one fastest", () => {
    expect([0, 1, 2, 3].map((i) => combination(suite.sweep!, i))).toEqual([[10, "x"], [10, "y"], [20, "x"], [20, "y"]]);
  });

  it("needs the shortest flight whose interval and share of plots reach the goal", () => {
    const flights = flightsOf(suite, "lattice/mean", "height_mean_m");
    expect(shortest(flights, { rmse: 0.03, found: 1 })).toBe(flights[0]); // b's interval reaches beyond, c misses a plot
    expect(shortest(flights, { rmse: 0.03, found: 0.9 })).toBe(flights[2]); // c has no interval: its RMSE counts
    expect(shortest(flights, { rmse: 0.005, found: 0 })).toBeUndefined();
    expect(reaches(flights[3], { rmse: 1, found: 0 })).toBe(false); // nothing was found
  });

  it("names its axes with their units", () => {
    expect(axisName("speed_m_s")).toEqual({ name: "speed", unit: "m/s" });
    expect(axisName("spacing_m")).toEqual({ name: "strip spacing", unit: "m" });
    expect(axisName("sensor")).toEqual({ name: "sensor", unit: "" });
  });
});
