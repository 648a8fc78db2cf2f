// A sweep: the flights, what each reached, and which is needed.
import { card, type Card } from "./card";
import type { Suite, Sweep } from "./data";
import { h, select } from "./dom";
import { csv, fixed, truthName } from "./numbers";
import { axisName, flightsOf, shortest, told, type Flight, type Goal } from "./sweep_data";
import { drawSweep, numberAxes, sweepMeasures, sweepNote, type SweepMeasure, type SweepOptions } from "./sweep_figure";
import { flightColumns } from "./sweep_table";
import { Table } from "./table";

// The heights of the table, each beside the truth that it is named after, and the one that is asked about.
function heightsOf(suite: Suite, sweep: Sweep): { method: string; truth: string }[] {
  const asked = { method: sweep.row, truth: sweep.truth };
  const rows = suite.table.filter((row) => row.named || row.truth === sweep.truth);
  const all = [asked, ...rows.map(({ method, truth }) => ({ method, truth }))];
  return all.filter(({ method, truth }, i) => all.findIndex((other) => other.method === method && other.truth === truth) === i);
}

export class SweepView {
  readonly sections: HTMLElement[] = [];
  private readonly sweep: Sweep;
  private readonly heights: { method: string; truth: string }[];
  private height = 0;
  private flights: Flight[] = [];
  private measure: SweepMeasure = "rmse";
  private x: number;
  private y?: number;
  private goal: Goal;
  private readonly said = h("p", { class: "answer", role: "status" });
  private readonly figure: Card;
  private readonly table: Table<Flight>;

  constructor(private readonly suite: Suite) {
    this.sweep = suite.sweep!;
    this.heights = heightsOf(suite, this.sweep);
    this.goal = { rmse: this.sweep.goal?.rmse_m ?? 0.03, found: this.sweep.goal?.found ?? 0.99 };
    const axes = numberAxes(this.sweep);
    [this.x, this.y] = [axes[0] ?? 0, axes[1]];
    this.read();
    this.figure = card(() => this.contours());
    this.figure.element.classList.add("wide");
    this.table = new Table({
      title: "Flights", columns: flightColumns(this.sweep, () => this.goal), rows: this.flights,
      note: "RMSE, bias and the error within fields over the plots found. Good enough: the upper end of the RMSE's interval (of a single farm the RMSE) and the share of plots found are." });
    this.tell();
    this.sections.push(
      h("section", { id: "figures" }, h("h2", {}, "Which flight do I need?"), this.tools(axes), this.said, this.figure.element),
      h("section", { id: "tables" }, h("h2", {}, "Tables"), this.table.element));
  }

  private read(): void {
    const { method, truth } = this.heights[this.height];
    this.flights = flightsOf(this.suite, method, truth);
  }

  private tools(axes: number[]): HTMLElement {
    const heights = this.heights.map(({ method, truth }, i) => ({ value: String(i), label: `${method} against the ${truthName(truth)}` }));
    const measures = (Object.keys(sweepMeasures) as SweepMeasure[]).map((measure) => ({ value: measure, label: sweepMeasures[measure].name }));
    const choices = axes.map((axis) => ({ value: String(axis), label: axisName(this.sweep.axes[axis].key).name }));
    const tools = h("div", { class: "tools" },
      select("Show", measures, this.measure, (measure) => this.change(() => (this.measure = measure as SweepMeasure))),
      heights.length > 1 ? select("Height", heights, "0", (height) => this.change(() => (this.height = Number(height)))) : null,
      this.limit("RMSE at most", "cm", 100 * this.goal.rmse, 0.1, (value) => (this.goal.rmse = value / 100)),
      this.limit("found at least", "%", 100 * this.goal.found, 1, (value) => (this.goal.found = value / 100)));
    if (axes.length > 2)
      tools.append(
        select("To the right", choices, String(this.x), (axis) => this.change(() => this.place(Number(axis), this.y!))),
        select("Up", choices, String(this.y), (axis) => this.change(() => this.place(this.x, Number(axis), true))));
    return tools;
  }

  // An axis that is chosen for one side leaves the other side.
  private place(x: number, y: number, upward = false): void {
    if (x === y) [x, y] = upward ? [this.y!, y] : [x, this.x];
    [this.x, this.y] = [x, y];
  }

  private limit(label: string, unit: string, value: number, step: number, set: (value: number) => void): HTMLElement {
    const box = h("input", { type: "number", min: 0, step, value: Number(value.toFixed(3)), input: () => {
      if (box.value !== "" && Number(box.value) >= 0) this.change(() => set(Number(box.value)));
    } });
    return h("label", { class: "choice" }, h("span", {}, label), box, h("span", {}, unit));
  }

  private change(how: () => void): void {
    how();
    this.read();
    this.tell();
    this.figure.update();
    this.table.rows(this.flights);
  }

  private tell(): void {
    const best = shortest(this.flights, this.goal);
    this.said.textContent = best
      ? `The shortest flight that is good enough: ${best.values.map((value, i) => told(this.sweep.axes[i].key, value)).join(", ")}; ${fixed(best.seconds, 0)} s in the air, RMSE ${fixed(100 * best.rmse, 2)} cm, ${best.found} of ${best.plots} plots found.`
      : "None of these flights is good enough.";
  }

  private contours() {
    const { method, truth } = this.heights[this.height];
    const { name, unit, of } = sweepMeasures[this.measure];
    const options: SweepOptions = { sweep: this.sweep, flights: this.flights, measure: this.measure, x: this.x, y: this.y, goal: this.goal };
    return {
      title: `${name[0].toUpperCase()}${name.slice(1)} by flight`,
      note: `${method} against the ${truthName(truth)}${sweepNote(options)}`,
      draw: (colours: Parameters<typeof drawSweep>[1], narrow: boolean) => drawSweep(options, colours, narrow),
      csv: () => csv([
        [...this.sweep.axes.map(({ key }) => key), `${this.measure}_${unit === "%" ? "percent" : unit}`, "rmse_low_cm", "rmse_high_cm", "plots", "found"],
        ...this.flights.map((flight) => [...flight.values, of(flight), 100 * flight.low, 100 * flight.high, flight.plots, flight.found])]),
    };
  }
}
