// What a suite of farms showed: figures and tables of its methods.
import { card, type Card } from "./card";
import type { Theme } from "./colours";
import type { Suite, TableRow } from "./data";
import { checkbox, h, select } from "./dom";
import {
  barsCsv, drawBars, drawHistograms, drawScatter, haveEnds, histogramsCsv, pairsCsv, references, rmseBars, withinBars,
  type Bar, type Group, type Method } from "./figures";
import { keptKinds } from "./heights";
import { truthName } from "./numbers";
import type { Pair } from "./statistics";
import { boxColumns, byMethod, heightColumns, number } from "./suite_table";
import { Table } from "./table";

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

export class SuiteView {
  readonly sections: HTMLElement[] = [];
  private truth: string;
  private chosen: string[] = [];
  private kinds = new Map<string, number>(); // colours of the chosen methods
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
    const histograms = card(() => this.histogramFigure());
    histograms.element.classList.add("wide");
    this.cards = [card(() => this.rmseFigure()), card(() => this.withinFigure()), card(() => this.scatterFigure()), histograms];
    if (suite.baseline) this.cards.splice(1, 0, card(() => this.changeFigure()));
    if (suite.cases.length > 1) this.cards.at(-2)!.element.classList.add("wide");
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
    const chips = all.map((method) => checkbox(method, first.includes(method), (on) => {
      this.chosen = all.filter((name) => (name === method ? on : this.chosen.includes(name)));
      for (const { control } of chips) if (control instanceof HTMLInputElement) control.disabled = !control.checked && this.chosen.length >= kMostMethods;
      this.update();
    }));
    this.chips.replaceChildren(...chips);
    this.compute();
  }

  private compute(): void {
    this.kinds = keptKinds(this.kinds, this.chosen);
    this.methods = this.chosen.map((name) => ({ name, kind: this.kinds.get(name)!, groups: groupsOf(this.suite, name, this.truth) }));
  }

  private update(): void {
    this.compute();
    for (const { update } of this.cards) update();
    this.heights?.rows(this.heightRows());
    const title = this.heights?.element.querySelector("h3");
    if (title) title.textContent = this.heightTitle();
  }

  // An error of the table with the ends of its 95 % interval.
  private tableBars(key: string): Bar[] {
    const pairsOf = (row: TableRow) => this.methods.find(({ name }) => name === row.method)?.groups.find(({ name }) => name === row.case)?.pairs;
    return this.suite.table.filter((row) => row.truth === this.truth && this.chosen.includes(row.method)).map((row) => ({
      group: row.case, method: row.method, kind: this.kinds.get(row.method)!, value: number(row, `${key}_m`), low: number(row, `${key}_low_m`),
      high: number(row, `${key}_high_m`), n: pairsOf(row)?.length ?? 0,
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
    const bars = this.spread === "interval" ? this.tableBars("rmse") : rmseBars(this.methods);
    const published = this.published();
    const how = this.spread === "interval" ? "95 % intervals by the bootstrap over farms" : this.jackknife();
    return {
      title: `Error against the ${truthName(this.truth)}`,
      note: `Root mean square error over the plots found, ${this.farms()}${haveEnds(bars) ? `; bars: ${how}` : ""}. n: plots.` +
        (Object.keys(published).length ? ` Dashed: ${this.suite.published!.source}.` : ""),
      draw: (theme: Theme, narrow: boolean) => drawBars("RMSE by case and method", "RMSE, cm", bars, theme, narrow, { published }),
      csv: () => barsCsv(bars, "rmse"),
    };
  }

  // Errors that were published of a chosen method, by case, metres.
  private published(): Record<string, number> {
    const { published, cases } = this.suite;
    if (!published?.methods.some((method) => this.chosen.includes(method))) return {};
    return Object.fromEntries(cases.flatMap(({ name, published_rmse_cm }) => (published_rmse_cm === undefined ? [] : [[name, published_rmse_cm / 100]])));
  }

  private changeFigure() {
    const { baseline } = this.suite;
    const bars = this.tableBars("rmse_change").filter(({ group }) => group !== baseline);
    return {
      title: `What each case changes against ${baseline}`,
      note: `RMSE minus that of the case ${baseline} on the same farms${haveEnds(bars) ? ", with its 95 % interval (bootstrap over farms, drawn in pairs)" : ""}.`,
      draw: (theme: Theme, narrow: boolean) => drawBars("Change of RMSE", "change of RMSE, cm", bars, theme, narrow),
      csv: () => barsCsv(bars, "rmse_change"),
    };
  }

  private withinFigure() {
    const bars = withinBars(this.methods);
    const lines = { references: references(this.methods) };
    return {
      title: "What is left within fields",
      note: `Root mean square of the errors less their farm's mean error: how well a method tells a field's plots apart${haveEnds(bars) ? `; bars: ${this.jackknife()}` : ""}.` +
        (bars.length ? " Dotted: the best single number for each field; a method above it has measured the field, not its plots." : ""),
      draw: (theme: Theme, narrow: boolean) => drawBars("Error within fields", "error within farms, cm", bars, theme, narrow, lines),
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
      note: "Estimate minus truth as a share of the truth, plots found. The CSV has those beyond the axis, too.",
      draw: (theme: Theme) => drawHistograms(this.methods, theme),
      csv: () => histogramsCsv(this.methods),
    };
  }
}
