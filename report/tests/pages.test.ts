import { readFileSync } from "node:fs";
import { drawn, type Drawn } from "./drawn";
import { describe, expect, it } from "vitest";
import { heightRamp, hex, light } from "../src/colours";
import type { Field, Height, Plot, Suite, Sweep, TableRow } from "../src/data";
import { errorFigure, knownHeights } from "../src/estimate";
import { plotColumns, plotNote } from "../src/field_table";
import { drawBars, drawHistograms, rmseBars } from "../src/figures";
import { firstHeight, flagLines, flagsOf, heightKinds, heightNames, keptKinds } from "../src/heights";
import { drawMap } from "../src/map";
import { drawProfile, groundUnder, profileCsv, profileNote, type ProfileOptions, type SidePoint } from "../src/profile";
import { heightColumns } from "../src/suite_table";
import type { Flight } from "../src/sweep_data";
import { drawSweep, marksLegend, numberAxes, sweepNote, type SweepOptions } from "../src/sweep_figure";
import { flightColumns } from "../src/sweep_table";
import { tableCsv, type Column } from "../src/table";

const all = ["max", "p99", "p95", "p90", "p50", "mean", "canopy_p99", "canopy_p95"];

const sure: Height = [0.9, 0.02, 0.85, 0.95];
const bare: Height = [0.9, null, null, null];

function plotOf(id: string, heights: Record<string, Height>, truths: Plot["truths"] = {}, box: Plot["box"] = [0, 0, 1.5, 4, 90]): Plot {
  return { id, row: 1, column: 1, box, heights, flags: [], truths, state: "" };
}

const fieldOf = (...plots: Plot[]): Field => ({ name: "field", facts: [], notes: [], path: [], plots, true_boxes: [] });
const heightsOf = (names: string[], height: Height) => Object.fromEntries(names.map((name) => [name, height]));

function csvOf<Row>(columns: Column<Row>[], rows: Row[]): Record<string, string>[] {
  const [head, ...lines] = tableCsv(columns, rows).trim().split("\r\n").map((line) => line.split(","));
  expect(new Set(head).size, head.join()).toBe(head.length);
  return lines.map((line) => Object.fromEntries(head.map((name, i) => [name, line[i]])));
}

describe("the CSV of a table", () => {
  it("of plots names the height of each interval and error", () => {
    const truths = Object.fromEntries(all.map((name) => [name.startsWith("canopy_") ? `${name}_m` : `height_${name}_m`, 0.6]));
    const field = fieldOf(plotOf("007", heightsOf(all, sure), truths), plotOf("8", heightsOf(all, [0.3 + 0.6, null, null, null]), truths));
    const [first, second] = csvOf(plotColumns(field), field.plots);
    for (const name of all) expect(first).toMatchObject({ [`${name} (m)`]: "0.9", [`${name} ± (cm)`]: "5", [`${name} error (cm)`]: "30" });
    expect(second).toMatchObject({ plot: "8", "p95 (m)": "0.9", "p95 ± (cm)": "" });
    expect(first.plot).toBe("007");
  });

  const row: TableRow = {
    case: "a", method: "lattice/max", truth: "height_max_m", named: true, shown: true, plots: 18, found: 17, rmse_m: 0.1 + 0.2, rmse_low_m: 0.01, rmse_high_m: 0.07, rmse_change_m: 0.001 };

  it("of a suite has both ends of an interval", () => {
    const suite = { cases: [{ name: "a", published_rmse_cm: 5 }], published: { source: "them", methods: ["lattice/max"] }, table: [row] } as unknown as Suite;
    const [line] = csvOf(heightColumns(suite), [row]);
    expect(line).toMatchObject({ "RMSE (cm)": "30", "RMSE low (cm)": "1", "RMSE high (cm)": "7", "published (cm)": "5" });
  });

  it("of a sweep has both ends of an interval, plots and those found", () => {
    const sweep = { axes: [{ key: "altitude_m", values: [10] }, { key: "speed_m_s", values: [3] }] } as unknown as Sweep;
    const [line] = csvOf(flightColumns(sweep, () => ({ rmse: 1, found: 1 })), [flightOf([10, 3], { rmse: 0.1 + 0.2, low: 0.01, high: 0.07, found: 17 })]);
    expect(line).toMatchObject({ "altitude (m)": "10", "RMSE (cm)": "30", "RMSE low (cm)": "1", "RMSE high (cm)": "7", found: "17", plots: "18" });
  });
});

describe("flags", () => {
  const plot = { ...plotOf("1", heightsOf(["mean", "p50"], sure)), flags: ["too few returns", "mean height is unsure by centimetres", "p50 height is unsure by centimetres"] };
  it("of one height concern no other", () => {
    expect(flagsOf(plot)).toEqual(["too few returns"]);
    expect(flagsOf(plot, "p50")).toEqual(["too few returns", "p50 height is unsure by centimetres"]);
    expect(flagsOf({ ...plot, flags: ["ground is unsure by centimetres"] }, "p50")).toHaveLength(1);
    expect(flagLines(plot)).toEqual(["too few returns", "unsure by centimetres: mean, p50"]);
  });

  it("mark plots on the map of the height that they concern", () => {
    const field = fieldOf({ ...plot, flags: ["mean height is unsure by centimetres"] });
    const widths = (height: string) => drawn(drawMap({ field, measure: "height", height }, light)).all("polygon").map(({ attributes }) => attributes["stroke-width"]);
    expect(widths("mean")).toContain("1.8");
    expect(widths("p50")).not.toContain("1.8");
  });
});

describe("notes", () => {
  it("of the plots' table explain the columns that there are", () => {
    const note = (height: Height, truths: Plot["truths"]) => plotNote(plotColumns(fieldOf(plotOf("1", { max: height }, truths))));
    expect(note(bare, {})).toBe("");
    expect(note(bare, { height_mean_m: 1 })).toBe("");
    expect(note(bare, { height_max_m: 1 })).toBe("Errors are estimate minus truth.");
    expect(note(sure, {})).toBe("± is half the width of the 95 % interval.");
  });

  it("of a plot from the side tell of lines and bands that are drawn", () => {
    const note = (plot: Plot, more: Partial<ProfileOptions> = {}) => profileNote(sideOf(plot, more));
    expect(note(plotOf("1", {}))).toBe("Seen along the plot's width.");
    expect(note(plotOf("1", { max: bare }), { ground: flat })).toBe("Seen along the plot's width. Lines over the ground along its middle are heights.");
    expect(note(plotOf("1", { max: sure }), { ground: flat })).toContain("are heights, bands their 95 % intervals.");
    expect(note(plotOf("1", { max: bare }))).toContain("heights above 0; no ground is known.");
  });

  it("of the heights' errors tell of error bars and the dotted line that are drawn", () => {
    const plots = [0.8, 0.95].map((truth, i) => plotOf(String(i), { max: sure, mean: sure, p95: sure }, { height_max_m: truth, height_mean_m: truth, height_p95_m: null }));
    const methods = knownHeights(fieldOf(...plots));
    expect(methods.map(({ name }) => name)).toEqual(["max", "mean"]);
    expect(errorFigure(methods).note).not.toContain("Dotted");
    expect(errorFigure(methods.slice(1)).note).toContain("its standard error (jackknife over plots)");
    expect(errorFigure(methods.slice(1)).note).toContain("Dotted");
    expect(errorFigure(knownHeights(fieldOf(plots[0]))).note).not.toContain("standard error");
  });

  it("of a sweep tell of the marks and bars that are drawn", () => {
    const enough = flightOf([10], { seconds: 50 });
    const long = flightOf([20], { seconds: 90 });
    const bad = flightOf([30], { rmse: 1 });
    const names = (...flights: Flight[]) => marksLegend(light, flights, { rmse: 0.03, found: 0.9 }).map(({ name, edge }) => (edge ? `o ${name}` : name));
    expect(names(enough, long, bad)).toEqual(["good enough: RMSE ≤ 3 cm, found ≥ 90 %", "o not good enough", "the shortest that is good enough"]);
    expect(names(enough, bad)).toEqual(["o not: RMSE ≤ 3 cm, found ≥ 90 %", "the shortest that is good enough"]);
    expect(names(enough, long)).toEqual(["good enough: RMSE ≤ 3 cm, found ≥ 90 %", "the shortest that is good enough"]);
    expect(names(bad)).toEqual(["o not: RMSE ≤ 3 cm, found ≥ 90 %"]);
    const lines = (measure: "rmse" | "bias", low: number) => sweepNote({ ...sweepOf([10]), measure, flights: [{ ...enough, low }] });
    expect(lines("rmse", 0.01)).toContain("Bars");
    for (const note of [lines("rmse", NaN), lines("bias", 0.01)]) expect(note).not.toMatch(/Bars|interpolated/);
  });
});

describe("a page of plots", () => {
  it("opens with the canopy's height where it is there", () => {
    expect(firstHeight(all)).toBe("canopy_p95");
    expect(firstHeight(["raw-max", "raw-p99"])).toBe("raw-max");
    expect(firstHeight([])).toBe("");
  });
});

describe("colours of heights", () => {
  const source = (name: string) => readFileSync(new URL(`../../viewer/view/internal/${name}`, import.meta.url), "utf8");
  const hexOf = (numbers: string[]) => hex(numbers.map(Number) as [number, number, number]);

  it("are those of plotview's pictures", () => {
    const lines = [...source("height_lines.cpp").matchAll(/\{"(\w+)", (k\w+)\}/g)];
    expect(lines.length).toBe(8);
    const kinds = heightKinds(fieldOf(plotOf("1", heightsOf(all, bare))));
    for (const [, name, constant] of lines) {
      const numbers = source("page.h").match(new RegExp(`Rgb ${constant}\\{(\\d+), (\\d+), (\\d+)\\}`))!;
      expect(light.kinds[kinds.get(name)!], name).toBe(hexOf(numbers.slice(1)));
    }
  });

  it("are plotview's from the ground to the top", () => {
    const text = source("height_colours.cpp");
    const steps = [...text.matchAll(/\{(\d+), (\d+), (\d+)\}/g)].map((found) => hexOf(found.slice(1)));
    const ground = Number(text.match(/kGround = ([\d.]+);/)![1]);
    expect(steps.length).toBe(9);
    for (let i = 1; i < 9; ++i) expect(hex(heightRamp((i - ground) / (8 - ground)))).toBe(steps[i]);
    expect(hex(heightRamp(-1))).toBe(hex(heightRamp(0)));
  });

  it("differ, and do not depend on what else is there", () => {
    const kinds = heightKinds(fieldOf(plotOf("1", heightsOf(all, bare))));
    expect(new Set(all.map((name) => light.kinds[kinds.get(name)!])).size).toBe(8);
    for (const name of all) expect(heightKinds(fieldOf(plotOf("1", { [name]: bare, other: bare }))).get(name)).toBe(kinds.get(name));
    const others = heightKinds(fieldOf(plotOf("1", heightsOf(["raw-max", "raw-p99", "voxel-max", "max"], bare))));
    expect(new Set(others.values()).size).toBe(4);
  });

  it("are the same in all figures, whichever are chosen", () => {
    const field = fieldOf(...[0.8, 0.95].map((truth, i) => plotOf(String(i), heightsOf(["max", "p95", "mean"], sure), { height_max_m: truth, height_p95_m: truth, height_mean_m: truth })));
    const methods = knownHeights(field);
    expect(methods.map(({ name }) => name)).toEqual(heightNames(field));
    const bars = (names: string[]) => drawn(drawBars("", "", rmseBars(methods.filter(({ name }) => names.includes(name))), light, false))
      .all("rect").filter((rect) => rect.all("title").length).map((rect) => [rect.words.split(",")[0], rect.attributes.fill]);
    const colour = Object.fromEntries(bars(["max", "p95", "mean"]));
    expect(Object.fromEntries(bars(["p95", "mean"]))).toEqual({ p95: colour.p95, mean: colour.mean });
    for (const height of ["max", "mean"])
      for (const label of drawn(drawProfile({ ...sideOf(field.plots[0], { ground: flat }), height }, light, false)).all("text"))
        if (label.attributes["font-weight"]) expect(label.attributes.fill).toBe(colour[label.words.split(" ")[0]]);
  });

  it("of chosen methods stay while these stay", () => {
    const before = keptKinds(new Map(), ["a", "b", "c"]);
    const after = keptKinds(before, ["b", "c", "d"]);
    expect([...after].sort()).toEqual([["b", 1], ["c", 2], ["d", 0]]);
  });
});

describe("a plot from the side", () => {
  const points: SidePoint[] = [[0.01, true], [0.5, true], [0.5, false]].map(([above, inside]) => ({ along: 1, z: above as number, above: above as number, inside: inside as boolean }));
  const entries = (more: Partial<ProfileOptions>) => drawn(drawProfile(sideOf(plotOf("1", { max: bare }), more), light, false)).all("text").map(({ words }) => words);

  it("stands on the method's plane where no ground was fitted", () => {
    const plot = plotOf("1", {});
    const plane = { id: "1", box: plot.box, z: 2, slope: [0.1, 0] as [number, number], tolerance: 0.05 };
    const field = { ...fieldOf(plot), workings: [{ method: "m", clusters: [], plots: [], planes: [{ ...plane, box: [9, 9, 1, 1, 0] as Plot["box"] }, plane] }] };
    expect(groundUnder(plot, field, {})!.height(1, 5)).toBeCloseTo(2.1, 12);
    expect(groundUnder(plot, fieldOf(plot), {})).toBeUndefined();
  });

  it("says how near the ground the brown points lie, and only of a known ground what is crop", () => {
    expect(entries({ points, ground: flat })).toEqual(expect.arrayContaining(["beyond the plot's ends", "crop", "within 7.5 cm of the ground", "fitted"]));
    const unknown = points.map((point) => ({ ...point, above: NaN }));
    expect(entries({ points: unknown })).toEqual(expect.arrayContaining(["over no known ground"]));
    expect(entries({ points: unknown })).not.toContain("crop");
    expect(profileCsv(sideOf(plotOf("1", {}), { points })).split("\r\n").slice(1, 4).map((line) => line.split(",")[4])).toEqual(["ground", "crop", "beyond"]);
  });

  it("has room for heights over a slope", () => {
    const slope = { name: "fitted", height: (_: number, y: number) => y };
    const labels = drawn(drawProfile(sideOf(plotOf("1", { max: sure }), { ground: slope }), light, false)).all("text").filter(({ attributes }) => attributes["font-weight"]);
    expect(Number(labels[0].attributes.y)).toBeGreaterThan(35); // the panel's top
  });

  it("tells of a ground's standard error where there is one", () => {
    expect(entries({ ground: { ...flat, standardError: () => 0.01 } })).toContain("fitted ± 1.96 SE");
  });
});

describe("a map", () => {
  // Where a turned title stands, and the left end of the widest text at a tick.
  const places = (texts: Drawn[]) => {
    const title = texts.find(({ words }) => words.startsWith("north"))!;
    const ticks = texts.filter(({ attributes }) => attributes["text-anchor"] === "end");
    return [title.words, Number(title.attributes.x), Math.min(...ticks.map(({ attributes, words }) => Number(attributes.x) - 6 * words.length))] as const;
  };

  it("has its title beside the ticks' texts, in any coordinates", () => {
    for (const north of [0, 499, 999.5, 4_511_999.6, 4_511_950.5, 123_456.7]) {
      const plots = [0, 0.5].map((up, i) => plotOf(String(i), { max: sure }, {}, [541_000, north + up, 0.7, 1, 0]));
      const [title, at, left] = places(drawn(drawMap({ field: fieldOf(...plots), measure: "height", height: "max" }, light)).all("text"));
      expect(at, title).toBeLessThan(left - 2);
      expect(at, title).toBeGreaterThan(9);
    }
  });
});

describe("histograms", () => {
  it("have their methods' names beside each other", () => {
    const methods = [0, 1, 2, 3, 4, 5, 6].map((kind) => ({ name: `a-method-of-a-long-name/height-${kind}`, kind, groups: [{ name: "case", pairs: [] }] }));
    const texts = drawn(drawHistograms(methods, light)).all("text").filter(({ words }) => words.startsWith("a-method"));
    const ends = texts.map(({ attributes, words }) => ({ y: attributes.y, from: Number(attributes.x), to: Number(attributes.x) + 6 * words.length }));
    expect(ends).toHaveLength(7);
    ends.slice(1).forEach((end, i) => expect(end.y !== ends[i].y || end.from > ends[i].to).toBe(true));
  });
});

describe("a sweep", () => {
  it("over names has them side by side", () => {
    const options = sweepOf(["vlp16", "puck"]);
    expect(numberAxes(options.sweep)).toEqual([]);
    const marks = drawn(drawSweep(options, light, false)).all("circle").map(({ attributes }) => Number(attributes.cx)).filter((x) => x > 60);
    expect(marks).toHaveLength(2);
    expect(marks[1]).toBeGreaterThan(marks[0]);
  });
});

const flat = { name: "fitted", height: () => 0 };

function sideOf(plot: Plot, more: Partial<ProfileOptions> = {}): ProfileOptions {
  return { plot, points: [], height: Object.keys(plot.heights)[0] ?? "", kinds: heightKinds(fieldOf(plot)), ...more };
}

function flightOf(values: Flight["values"], more: Partial<Flight> = {}): Flight {
  return { values, farms: 2, plots: 18, found: 18, extra: 0, rmse: 0.01, low: NaN, high: NaN, bias: 0, within: 0, seconds: 60, points: 1e6, ...more };
}

function sweepOf(values: Flight["values"]): SweepOptions {
  const sweep: Sweep = { axes: [{ key: "sensor", values }], height: "mean", truth: "height_mean_m", row: "lattice/mean", flights: [] };
  return { sweep, flights: values.map((value) => flightOf([value])), measure: "rmse", x: 0, goal: { rmse: 0.03, found: 0.9 } };
}
