import { describe, expect, it } from "vitest";
import { bias, oneNumber, r2, r2Within, relativeErrors, rmse, standardError, within, type Pair } from "../src/statistics";

const pairs = (rows: [number, number, number][]): Pair[] =>
  rows.map(([farm, truth, error]) => ({ farm, truth, estimate: truth + error, label: "" }));

describe("statistics", () => {
  // The example of tests/benchmarks/table_test.cpp: errors 3 and -1, 2 and 4, and 5 cm.
  const some = pairs([[1, 1.0, 0.03], [1, 1.2, -0.01], [2, 1.1, 0.02], [2, 1.3, 0.04], [3, 0.9, 0.05]]);

  it("agrees with the table's own figures", () => {
    expect(rmse(some)).toBeCloseTo(Math.sqrt((9 + 1 + 4 + 16 + 25) / 5) / 100, 12);
    expect(bias(some)).toBeCloseTo(0.026, 12);
    expect(within(some)).toBeCloseTo(Math.sqrt((4 + 4 + 1 + 1) / 5) / 100, 12);
  });

  it("gives the coefficient of determination against estimate = truth", () => {
    expect(r2(pairs([[1, 1, 0], [1, 2, 0]]))).toBe(1);
    expect(r2(pairs([[1, 1, 0.5], [1, 2, -0.5]]))).toBeCloseTo(0, 12); // the mean truth everywhere
    expect(r2(pairs([[1, 1, 0.1], [1, 1, 0.1]]))).toBeNaN();
  });

  it("is blind to a farm's bias and to scale within farms", () => {
    const scaled = [1, 2, 3].map((truth) => ({ farm: 1, truth, estimate: 5 + 0.1 * truth, label: "" }));
    const moved = [1, 2, 4].map((truth) => ({ farm: 2, truth, estimate: -7 + 0.1 * truth, label: "" }));
    expect(r2Within([...scaled, ...moved])).toBeCloseTo(1, 12);
  });

  it("takes one number for each field as its mean", () => {
    // Truths 1 and 3 on one farm, 5 on another: the spread about 2 and 5.
    expect(oneNumber(pairs([[1, 1, 9], [1, 3, 9], [2, 5, 9]]))).toBeCloseTo(Math.sqrt(2 / 3), 12);
  });

  it("jackknifes as the standard error of a mean where the RMSE is one", () => {
    // Of squared errors all alike there is no doubt; of two farms the closed form is half their difference.
    expect(standardError(pairs([[1, 1, 0.1], [2, 1, -0.1], [3, 1, 0.1]]), rmse)).toBeCloseTo(0, 12);
    expect(standardError(pairs([[1, 1, 0.1], [2, 1, 0.3]]), rmse)).toBeCloseTo(0.1, 12);
    expect(standardError(pairs([[1, 1, 0.1]]), rmse)).toBeNaN();
  });

  it("jackknifes a mean to the spread of its values", () => {
    // Of a mean the jackknife's standard error is s / sqrt(n), exactly.
    const errors = [0.01, 0.04, -0.02, 0.06];
    const middle = errors.reduce((sum, value) => sum + value, 0) / 4;
    const spread = Math.sqrt(errors.reduce((sum, value) => sum + (value - middle) ** 2, 0) / 3);
    expect(standardError(pairs(errors.map((value, i) => [i, 1, value])), bias)).toBeCloseTo(spread / 2, 12);
  });

  it("leaves out groups where there are many, and finds about the same", () => {
    const errors = Array.from({ length: 500 }, (_, i) => 0.05 * Math.sin(12.9898 * i * i));
    const many = errors.map((value, i) => ({ farm: i, truth: 1, estimate: 1 + value, label: "" }));
    const middle = errors.reduce((sum, value) => sum + value, 0) / 500;
    const spread = Math.sqrt(errors.reduce((sum, value) => sum + (value - middle) ** 2, 0) / 499);
    const exact = spread / Math.sqrt(500);
    expect(Math.abs(standardError(many, bias) / exact - 1)).toBeLessThan(0.25);
  });

  it("counts relative errors in bins whose edges are multiples of 5 %", () => {
    const bins = relativeErrors(pairs([[1, 1, 0.01], [1, 1, 0.049], [1, 1, -0.01], [1, 2, 0.12]]));
    expect(bins.map(({ low, count }) => [Math.round(100 * low), count])).toEqual([[-5, 1], [0, 2], [5, 1]]);
    expect(bins.reduce((sum, { share }) => sum + share, 0)).toBeCloseTo(1, 12);
  });
});
