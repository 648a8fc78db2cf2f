// What a suite of farms showed: figures and tables of its methods.
import { card, type Card } from "./card";
import type { Theme } from "./colours";
import type { Report, Suite, TableRow } from "./data";
import { checkbox, h, select } from "./dom";
import {
  barsCsv, drawBars, drawHistograms, drawScatter, histogramsCsv, pairsCsv, references, rmseBars, withinBars,
  type Bar, type Group, type Method } from "./figures";
import { counted, fixed, namedTruth, signed, truthName } from "./numbers";
import type { Pair } from "./statistics";
import { Table, type Column } from "./table";

const kMostMethods = 7;

// The pairs of a series and a truth, a group a case.
export function groupsOf(suite: Suite, row: string, truth: string): Group[] {
  const series = suite.series.find((candidate) => candidate.row === row);
  const groups = new Map<string, Pair[]>(suite.cases.map(({ name }) => [name, []]));
  let at = 0;
  suite.farms.forEach((farm, number) => {
    for (let i = 0; i < farm.plot_numbers.length; ++i, ++at) {
      const estimate = series?.values[at];
      const known = suite.plots[truth]?.[at];
      if (estimate !== null && estimate !== undefined && known !== null && known !== undefined)
        groups.get(farm.case)?.push({ estimate, truth: known, farm: number, label: `farm ${farm.seed}, plot ${farm.plot_numbers[i]}` });
    }
  });
  return [...groups].map(([name, pairs]) => ({ name, pairs }));
}

// Which methods stand beside a truth, as the table says, and which of them are shown at first.
export function methodsBeside(suite: Suite, truth: string): { all: string[]; first: string[] } {
  const all = [...new Set(suite.table.filter((row) => row.truth === truth && row.shown).map((row) => row.method))];
  const named = all.filter((method) => suite.table.some((row) => row.method === method && row.truth === truth && row.named));
  const published = suite.published?.methods ?? [];
  const oracle = all.filter((method) => method === "oracle-ground");
  const first = [...new Set([...named.filter((method) => !method.startsWith("one-number")).slice(0, 2), ...all.filter((method) => published.includes(method)), ...oracle])];
  return { all, first: (first.length > 0 ? first : all).slice(0, 5) };
}

// Method by method in their order, a method's cases together.
function byMethod(rows: TableRow[]): TableRow[] {
  const methods = [...new Set(rows.map((row) => row.method))];
  return methods.flatMap((method) => rows.filter((row) => row.method === method));
}

const number = (row: TableRow, key: string): number => (typeof row[key] === "number" ? (row[key] as number) : NaN);

function cmColumn(title: string, key: string, digits = 2, hint?: string, sign = false): Column<TableRow> {
  return {
    title, unit: "cm", hint, value: (row) => 100 * number(row, key),
    shown: (row) => (sign ? signed : fixed)(100 * number(row, key), digits) };
}

const plain = (title: string, key: string, digits: number, hint?: string): Column<TableRow> =>
  ({ title, hint, value: (row) => number(row, key), shown: (row) => fixed(number(row, key), digits) });

const text = (title: string, key: string): Column<TableRow> => ({ title, value: (row) => String(row[key] ?? "") });

function heightColumns(suite: Suite): Column<TableRow>[] {
  const columns: Column<TableRow>[] = [
    text("method", "method"), text("case", "case"), plain("plots", "plots", 0), plain("found", "found", 0),
    plain("without", "without", 0, "found plots without this height"),
    { ...cmColumn("RMSE", "rmse_m"), shown: (row) => fixed(100 * number(row, "rmse_m"), 2) },
    { title: "95 % interval", unit: "cm", hint: "bootstrap over farms", value: (row) => 100 * number(row, "rmse_low_m"),
      shown: (row) => Number.isFinite(number(row, "rmse_low_m")) ? `${fixed(100 * number(row, "rmse_low_m"), 2)} – ${fixed(100 * number(row, "rmse_high_m"), 2)}` : "" },
  ];
  if (suite.published) columns.push({
    title: "published", unit: "cm", hint: suite.published.source,
    value: (row) => (suite.published!.methods.includes(row.method) ? suite.cases.find(({ name }) => name === row.case)?.published_rmse_cm : undefined),
    shown: (row) => suite.published!.methods.includes(row.method) ? fixed(suite.cases.find(({ name }) => name === row.case)?.published_rmse_cm, 1) : "" });
  if (suite.table.some((row) => Number.isFinite(number(row, "rmse_change_m"))))
    columns.push(cmColumn("change", "rmse_change_m", 2, "RMSE minus the baseline case's, on the same farms", true));
  return [...columns,
    cmColumn("bias", "bias_m", 2, "mean of estimate minus truth", true), cmColumn("MAE", "mae_m"), plain("R²", "r2", 2, "against the line estimate = truth"),
    cmColumn("bias a farm", "farm_bias_m", 2, "root mean square of the farms' own mean errors"),
    cmColumn("within farms", "within_m", 2, "root mean square of the errors less their farm's mean error"),
    plain("R² within", "r2_within", 2), plain("ρ within", "rho_within", 2, "Spearman's rank correlation within farms"),
    { title: "truths in 95 %", unit: "%", hint: "share of truths inside the method's own 95 % intervals", value: (row) => 100 * number(row, "coverage95"), shown: (row) => fixed(100 * number(row, "coverage95"), 1) },
    plain("flagged", "flagged", 0, "found plots with a flag"),
    plain("over 5 cm, no flag", "large_unflagged", 0, "found plots in error by more than 5 cm that carry no flag"),
    plain("time", "seconds", 2, "median seconds a farm"),
  ];
}

const boxColumns: Column<TableRow>[] = [
  text("method", "method"), text("case", "case"), plain("plots", "plots", 0), plain("found", "found", 0), plain("missed", "missed", 0),
  plain("extra", "extra", 0, "estimated plots that are none"), plain("recall", "recall", 4), plain("precision", "precision", 4),
  plain("IoU mean", "iou_mean", 3, "intersection over union of the boxes"), plain("IoU least", "iou_min", 3),
  cmColumn("centre", "center_rmse_m", 2, "root mean square distance of the centres"),
  { title: "heading", unit: "°", value: (row) => number(row, "heading_rmse_deg"), shown: (row) => fixed(number(row, "heading_rmse_deg"), 3) },
];

export class SuiteView {
  readonly sections: HTMLElement[] = [];
  private truth: string;
  private chosen: string[] = [];
  private spread: "interval" | "error" = "interval";
  private methods: Method[] = [];
  private readonly chips = h("div", { class: "chips", role: "group", "aria-label": "Methods in the figures" });
  private cards: Card[] = [];
  private heights?: Table<TableRow>;

  constructor(private readonly suite: Suite) {
    const truths = [...new Set(suite.table.map((row) => row.truth))].filter((truth) => truth !== "");
    this.truth = suite.truths.find((truth) => truths.includes(truth)) ?? truths[0] ?? "";
    if (truths.length > 0) this.addFigures(truths);
    this.addTables();
  }

  private addFigures(truths: string[]): void {
    const { suite } = this;
    const ordered = [...suite.truths.filter((truth) => truths.includes(truth)), ...truths.filter((truth) => !suite.truths.includes(truth))];
    this.choose(this.truth);
    const tools = h("div", { class: "tools" },
      select("Truth", ordered.map((truth) => ({ value: truth, label: truthName(truth) })), this.truth, (truth) => {
        this.choose(truth);
        this.update();
      }),
      select("Error bars", [{ value: "interval", label: "95 % interval (bootstrap over farms)" }, { value: "error", label: "standard error (jackknife)" }], this.spread, (spread) => {
        this.spread = spread as "interval" | "error";
        this.update();
      }));
    this.cards = [card(() => this.rmseFigure()), card(() => this.withinFigure()), card(() => this.scatterFigure()), card(() => this.histogramFigure())];
    if (suite.baseline) this.cards.splice(1, 0, card(() => this.changeFigure()));
    if (suite.cases.length > 1) this.cards.slice(-2).forEach(({ element }) => element.classList.add("wide"));
    if (suite.cases.length > 4) this.cards.forEach(({ element }) => element.classList.add("wide"));
    this.sections.push(h("section", { id: "figures" }, h("h2", {}, "Heights against the truth"), tools, this.chips,
      h("div", { class: "grid" }, ...this.cards.map(({ element }) => element))));
  }

  private addTables(): void {
    const { suite } = this;
    const section = h("section", { id: "tables" }, h("h2", {}, "Tables"));
    if (this.truth) {
      this.heights = new Table({ title: this.heightTitle(), columns: heightColumns(suite), rows: this.heightRows() });
      section.append(this.heights.element);
    }
    section.append(new Table({
      title: "Plots found", columns: boxColumns, rows: suite.boxes,
      note: "A plot is found where its box and an estimated one overlap by an intersection over union of at least 0.5, one to one.",
    }).element);
    const named = byMethod(suite.table.filter((row) => row.named));
    if (named.length > 0)
      section.append(new Table({ title: "Each height against the truth it is named after", columns: [{ title: "truth", value: (row) => truthName(row.truth) }, ...heightColumns(suite)], rows: named }).element);
    this.sections.push(section);
  }

  private heightTitle(): string {
    return `Heights against the ${truthName(this.truth)}`;
  }

  private heightRows(): TableRow[] {
    return byMethod(this.suite.table.filter((row) => row.truth === this.truth && row.shown));
  }

  private choose(truth: string): void {
    this.truth = truth;
    const { all, first } = methodsBeside(this.suite, truth);
    this.chosen = first;
    this.chips.replaceChildren(...all.map((method) => checkbox(method, first.includes(method), (on) => {
      this.chosen = all.filter((name) => (name === method ? on : this.chosen.includes(name))).slice(0, kMostMethods);
      this.update();
    })));
    this.compute();
  }

  private compute(): void {
    this.methods = this.chosen.map((name) => ({ name, groups: groupsOf(this.suite, name, this.truth) }));
  }

  private update(): void {
    this.compute();
    for (const { update } of this.cards) update();
    this.heights?.rows(this.heightRows());
    const title = this.heights?.element.querySelector("h3");
    if (title) title.textContent = this.heightTitle();
  }

  private intervalBars(): Bar[] {
    return this.suite.table.filter((row) => row.truth === this.truth && this.chosen.includes(row.method)).map((row) => ({
      group: row.case, method: row.method, value: number(row, "rmse_m"), low: number(row, "rmse_low_m"), high: number(row, "rmse_high_m"),
      n: this.methods.find(({ name }) => name === row.method)?.groups.find(({ name }) => name === row.case)?.pairs.length ?? 0,
    })).sort((a, b) => this.chosen.indexOf(a.method) - this.chosen.indexOf(b.method));
  }

  private farms(): string {
    const counts = this.suite.cases.map(({ name }) => this.suite.farms.filter((farm) => farm.case === name).length);
    const same = counts.every((count) => count === counts[0]);
    return same ? `${counts[0]} farm${counts[0] === 1 ? "" : "s"} a case` : `${this.suite.farms.length} farms`;
  }

  // What the plots of one farm share shows only where a case has several.
  private jackknife(): string {
    const several = this.suite.cases.every(({ name }) => this.suite.farms.filter((farm) => farm.case === name).length > 1);
    return `standard errors by the jackknife over ${several ? "farms" : "plots where a case has one farm (they lack what its plots share), else over farms"}`;
  }

  private rmseFigure() {
    const bars = this.spread === "interval" ? this.intervalBars() : rmseBars(this.methods);
    const published: Record<string, number | undefined> = {};
    if (this.suite.published && this.chosen.some((method) => this.suite.published!.methods.includes(method)))
      for (const { name, published_rmse_cm } of this.suite.cases) published[name] = published_rmse_cm === undefined ? undefined : published_rmse_cm / 100;
    const how = this.spread === "interval" ? "95 % intervals by the bootstrap over farms" : this.jackknife();
    return {
      title: `Error against the ${truthName(this.truth)}`,
      note: `Root mean square error over the plots found, ${this.farms()}; bars: ${how}. n: plots.` +
        (Object.keys(published).length ? ` Dashed: ${this.suite.published!.source}.` : ""),
      draw: (theme: Theme, narrow: boolean) => drawBars("RMSE by case and method", "RMSE, cm", bars, theme, narrow, { published }),
      csv: () => barsCsv(bars, "rmse"),
    };
  }

  private changeFigure() {
    const { suite } = this;
    const bars: Bar[] = suite.table.filter((row) => row.truth === this.truth && this.chosen.includes(row.method) && row.case !== suite.baseline).map((row) => ({
      group: row.case, method: row.method, value: number(row, "rmse_change_m"), low: number(row, "rmse_change_low_m"), high: number(row, "rmse_change_high_m"), n: number(row, "plots") }));
    return {
      title: `What each case changes against ${suite.baseline}`,
      note: `RMSE minus that of the case ${suite.baseline} on the same farms, with its 95 % interval (bootstrap over farms, drawn in pairs).`,
      draw: (theme: Theme, narrow: boolean) => drawBars("Change of RMSE", "change of RMSE, cm", bars, theme, narrow),
      csv: () => barsCsv(bars, "rmse_change"),
    };
  }

  private withinFigure() {
    const bars = withinBars(this.methods);
    return {
      title: "What is left within fields",
      note: `Root mean square of the errors less their farm's mean error: how well a method tells a field's plots apart; bars: ${this.jackknife()}. Dotted: the best single number for each field; a method above it has measured the field, not its plots.`,
      draw: (theme: Theme, narrow: boolean) => drawBars("Error within fields", "error within farms, cm", bars, theme, narrow, { references: references(this.methods) }),
      csv: () => barsCsv(bars, "within"),
    };
  }

  private scatterFigure() {
    return {
      title: "Estimated against true heights",
      note: `A mark a plot found; the line is estimate = truth. R² against that line, and of a line through the plots within farms. Truth: ${truthName(this.truth)}.`,
      draw: (theme: Theme, narrow: boolean) => drawScatter(this.methods, theme, narrow),
      csv: () => pairsCsv(this.methods),
    };
  }

  private histogramFigure() {
    return {
      title: "Relative errors in bins of 5 %",
      note: "Estimate minus truth as a share of the truth, plots found. Errors beyond the axis are in the CSV.",
      draw: (theme: Theme) => drawHistograms(this.methods, theme),
      csv: () => histogramsCsv(this.methods),
    };
  }
}

// The same figures of one estimate whose truth is known: a method a height.
export function estimateFigures(report: Report): HTMLElement | undefined {
  const field = report.fields[0];
  const heights = [...new Set(field.plots.flatMap((plot) => Object.keys(plot.heights)))];
  const methods: Method[] = heights.map((height) => ({
    name: height,
    groups: [{ name: field.name, pairs: field.plots.flatMap((plot) => {
      const truth = plot.truths[namedTruth(height)];
      const value = plot.heights[height];
      return truth === undefined || !value ? [] : [{ estimate: value[0], truth, farm: 0, label: `plot ${plot.id}` }];
    }) }],
  })).filter((method) => method.groups[0].pairs.length > 0);
  if (methods.length === 0) return undefined;
  let chosen = ["max", "mean", "p95"].filter((name) => methods.some((method) => method.name === name));
  if (chosen.length === 0) chosen = methods.slice(0, 3).map((method) => method.name);
  const shown = () => methods.filter((method) => chosen.includes(method.name));
  const n = counted(methods[0].groups[0].pairs.length);
  const cards = [
    card(() => ({
      title: "Error of each height", note: `Root mean square error and its standard error (jackknife over plots) against the truth that each height is named after, n = ${n} plots. Dotted: one number for the whole field.`,
      draw: (theme, narrow) => drawBars("RMSE of each height", "RMSE, cm", rmseBars(shown()), theme, narrow, shown().length === 1 ? { references: references(shown()) } : {}),
      csv: () => barsCsv(rmseBars(shown()), "rmse") })),
    card(() => ({
      title: "Estimated against true heights", note: "A mark a plot; the line is estimate = truth. R² against that line, and within: the square of their correlation.",
      draw: (theme, narrow) => drawScatter(shown(), theme, narrow), csv: () => pairsCsv(shown()) })),
    card(() => ({
      title: "Relative errors in bins of 5 %", note: "Estimate minus truth as a share of the truth.",
      draw: (theme) => drawHistograms(shown(), theme), csv: () => histogramsCsv(shown()) })),
  ];
  const chips = h("div", { class: "chips", role: "group", "aria-label": "Heights in the figures" }, ...methods.map(({ name }) =>
    checkbox(name, chosen.includes(name), (on) => {
      chosen = methods.map((method) => method.name).filter((other) => (other === name ? on : chosen.includes(other)));
      for (const { update } of cards) update();
    })));
  return h("section", { id: "figures" }, h("h2", {}, "Heights against the truth"), chips, h("div", { class: "grid three" }, ...cards.map(({ element }) => element)));
}
