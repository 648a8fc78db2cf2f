import { describe, expect, it } from "vitest";
import { csv, fixed, namedTruth, quantile, signed, ticks } from "../src/numbers";
import { fileName } from "../src/save";
import { corners } from "../src/place";

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

  it("have quantiles linear between order statistics", () => {
    expect(quantile([1, 2, 3, 4], 0.5)).toBe(2.5);
    expect(quantile([], 0.5)).toBeNaN();
  });

  it("go into CSV as RFC 4180 has it", () => {
    expect(csv([["a", 1, NaN, null], ['say "x", y', -2, undefined, "line\nbreak"]])).toBe(
      'a,1,,\r\n"say ""x"", y",-2,,"line\nbreak"\r\n');
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
