// The figures of one estimate whose truth is known: a method a height.
import { card, type Figure } from "./card";
import type { Field } from "./data";
import { checkbox, h } from "./dom";
import { barsCsv, drawBars, drawHistograms, drawScatter, haveEnds, histogramsCsv, pairsCsv, references, rmseBars, type Lines, type Method } from "./figures";
import { heightKinds, heightNames } from "./heights";
import { measured } from "./map";
import { counted } from "./numbers";

// The heights of which any plot has the truth.
export function knownHeights(field: Field): Method[] {
  const kinds = heightKinds(field);
  const methods = heightNames(field).map((height) => ({
    name: height, kind: kinds.get(height)!,
    groups: [{ name: field.name, pairs: field.plots.map((plot) => (
      { estimate: measured(plot, "height", height), truth: measured(plot, "truth", height), farm: 0, label: `plot ${plot.id}` }))
      .filter(({ estimate, truth }) => Number.isFinite(estimate) && Number.isFinite(truth)) }],
  }));
  return methods.filter(({ groups }) => groups[0].pairs.length > 0);
}

// The error of each height; of one alone beside that of one number.
export function errorFigure(methods: Method[]): Figure {
  const bars = rmseBars(methods);
  const lines: Lines = methods.length === 1 ? { references: references(methods) } : {};
  return {
    title: "Error of each height",
    note: `Root mean square error${haveEnds(bars) ? " and its standard error (jackknife over plots)" : ""} against the truth that each height is named after, n = ` +
      `${counted(Math.max(0, ...bars.map(({ n }) => n)))} plots.${lines.references ? " Dotted: one number for the whole field." : ""}`,
    draw: (theme, narrow) => drawBars("RMSE of each height", "RMSE, cm", bars, theme, narrow, lines),
    csv: () => barsCsv(bars, "rmse"),
  };
}

export function estimateFigures(field: Field): HTMLElement | undefined {
  const methods = knownHeights(field);
  if (methods.length === 0) return undefined;
  const common = methods.filter(({ name }) => ["max", "mean", "p95"].includes(name));
  const chosen = new Set(common.length ? common : methods.slice(0, 3));
  const shown = () => methods.filter((method) => chosen.has(method));
  const cards = [
    card(() => errorFigure(shown())),
    card(() => ({
      title: "Estimated against true heights", note: "A mark a plot; the line is estimate = truth. R² against that line, and within: the square of their correlation.",
      draw: (theme, narrow) => drawScatter(shown(), theme, narrow), csv: () => pairsCsv(shown()) })),
    card(() => ({
      title: "Relative errors in bins of 5 %", note: "Estimate minus truth as a share of the truth. The CSV has those beyond the axis, too.",
      draw: (theme) => drawHistograms(shown(), theme), csv: () => histogramsCsv(shown()) })),
  ];
  cards[2].element.classList.add("wide");
  const chips = methods.map((method) => checkbox(method.name, chosen.has(method), (on) => {
    if (on) chosen.add(method);
    else chosen.delete(method);
    for (const { update } of cards) update();
  }));
  return h("section", { id: "figures" }, h("h2", {}, "Heights against the truth"),
    h("div", { class: "chips", role: "group", "aria-label": "Heights in the figures" }, ...chips), h("div", { class: "grid" }, ...cards.map(({ element }) => element)));
}
