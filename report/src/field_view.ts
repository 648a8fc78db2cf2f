// One field: its points in three dimensions, the map of its plots, a plot from the side, their table.
import { card, type Card } from "./card";
import type { Theme } from "./colours";
import { lookOf, modesOf, type Key, type Mode } from "./colouring";
import type { Field, Plot } from "./data";
import { Surface } from "./decode";
import { button, checkbox, h, select } from "./dom";
import { plotColumns, plotNote } from "./field_table";
import { firstHeight, flagLines, flagsOf, heightKinds, heightNames } from "./heights";
import { drawMap, mapCsv, measured, measureNames, type Measure } from "./map";
import { counted, fixed, namedTruth, signed, truthName } from "./numbers";
import type { Grounds } from "./place";
import { drawProfile, groundUnder, pointsOver, profileCsv, profileHeights, profileNote } from "./profile";
import { saveButtons } from "./save";
import { Scene, type Layer } from "./scene";
import { Table } from "./table";
import { onTheme, theme } from "./theme";
import { drawInliers, drawVoting, inliersCsv, inliersNote, votingCsv } from "./working";

function keyElement(key: Key): HTMLElement {
  if (key.kinds)
    return h("div", { class: "key" }, ...key.kinds.map(({ name, colour }) =>
      h("span", {}, h("i", { style: `background:${colour}` }), name)));
  const { low, high, css, unit, title } = key.ramp!;
  const digits = high - low < 20 ? 2 : 0;
  return h("div", { class: "key ramp" }, h("span", {}, unit ? `${title}, ${unit}` : title),
    h("span", { class: "scale" }, fixed(low, digits), h("i", { style: `background:${css}` }), fixed(high, digits)));
}

// A name and its numbers in each row.
const smallTable = (titles: string[], rows: string[][]): HTMLElement =>
  h("table", {}, h("thead", {}, h("tr", {}, ...titles.map((title) => h("th", { scope: "col" }, title)))),
    h("tbody", {}, ...rows.map((row) => h("tr", {}, ...row.map((words, i) => h("td", { class: i ? "number" : undefined }, words))))));

export class FieldView {
  readonly element = h("div", { class: "field" });
  private grounds: Grounds = {};
  private scene?: Scene;
  private selected?: Plot;
  private height: string;
  private measure: Measure;
  private mode: Mode = "elevation";
  private table?: Table<Plot>;
  private map?: { update: () => void };
  private profile?: { update: () => void };
  private readonly workings: Card[] = [];
  private readonly status = h("p", { class: "status", role: "status" });
  private readonly key = h("div", { class: "keys" });
  private readonly details = h("div", { class: "details" });

  constructor(readonly field: Field) {
    const names = heightNames(field);
    this.height = firstHeight(names);
    this.measure = names.length ? "height" : "truth";
  }

  // Builds the view; resolves once the points are read.
  async open(): Promise<void> {
    const { field } = this;
    if (field.ground) this.grounds.ground = await Surface.of(field.ground);
    if (field.terrain) this.grounds.terrain = await Surface.of(field.terrain);
    this.element.replaceChildren(...this.parts());
    this.startScene();
    if (field.plots.length > 0) this.pick(field.plots[0]);
    await this.loadCloud();
  }

  close(): void {
    this.scene?.dispose();
    this.scene = undefined;
  }

  private parts(): (Node | string)[] {
    const { field } = this;
    const parts: (Node | string)[] = [h("p", { class: "facts" }, ...field.facts.map(([name, value]) =>
      h("span", {}, `${name} `, h("b", {}, /^\d+$/.test(value) ? counted(Number(value)) : value))))];
    for (const note of field.notes) parts.push(h("p", { class: "warning" }, note));
    const stage = h("div", { class: "stage", id: "stage" });
    const view = h("section", { class: "card view", "aria-label": "Three dimensions" }, this.viewTools(), stage, this.status);
    if (field.plots.length === 0) return [...parts, view];
    const map = card(() => ({
      title: "Map of the plots",
      note: this.mapNote(),
      draw: (colours) => drawMap({ field, measure: this.measure, height: this.heightOrTruth(), selected: this.selected, pick: (plot) => this.pick(plot, "map") }, colours),
      csv: () => mapCsv(field, this.measure, this.heightOrTruth()),
    }));
    this.map = map;
    map.element.classList.add("map");
    map.element.querySelector(".head")!.after(this.mapTools());
    parts.push(h("div", { class: "pair" }, view, map.element));
    const profile = card(() => this.profileFigure());
    this.profile = profile;
    profile.element.classList.add("profile");
    profile.element.append(this.details);
    this.table = this.plotTable();
    parts.push(profile.element, ...this.workingCards(), this.table.element);
    return parts;
  }

  // What of the methods' workings can be shown; drawn anew once all points are read.
  private workingCards(): HTMLElement[] {
    const { field, grounds } = this;
    for (const working of field.workings ?? []) {
      const options = () => ({ field, working, cloud: this.scene?.cloud?.cloud, tiles: this.scene?.cloud?.read ?? [], grounds });
      if (working.clusters.length > 0) this.workings.push(card(() => ({
        title: `Boxes before and after voting: ${working.method}`,
        note: "(a) The least rectangle around each cluster of k-means; (b) the grid of boxes of the size and heading that most clusters agree on.",
        draw: (colours, narrow) => drawVoting(options(), colours, narrow), csv: () => votingCsv(options()) })));
      if (working.planes.length > 0) this.workings.push(card(() => ({
        title: `Ground inliers of plots: ${working.method}`,
        note: inliersNote(options()),
        draw: (colours, narrow) => drawInliers(options(), colours, narrow), csv: () => inliersCsv(options()) })));
    }
    const cards = this.workings.map(({ element }) => element);
    return cards.length > 0 ? [h("div", { class: "grid workings" }, ...cards)] : [];
  }

  private heightOrTruth(): string {
    return this.height || (Object.keys(this.field.plots[0]?.truths ?? {})[0] ?? "").replace(/^height_|_m$/g, "");
  }

  private mapNote(): string {
    const parts = [this.field.cloud ? "North is up; coordinates are the cloud's." : "North is up."];
    if (this.field.plots.some((plot) => flagsOf(plot, this.height).length > 0)) parts.push("Orange outlines: plots with a flag of this height.");
    if (this.field.true_boxes.some((plot) => !plot.found)) parts.push("Dashed: plots that were missed.");
    return `n = ${counted(this.field.plots.length)}. ${parts.join(" ")}`;
  }

  private viewTools(): HTMLElement {
    const { field } = this;
    const layers: [Layer, string, boolean, boolean][] = [
      ["points", "points", field.cloud !== undefined, true],
      ["boxes", "boxes", field.plots.length > 0, true],
      ["numbers", "numbers", field.plots.length > 0, field.plots.length <= 60],
      ["truth", "true boxes", field.true_boxes.length > 0, true],
      ["ground", "fitted ground", this.grounds.ground !== undefined, true],
      ["terrain", "true ground", this.grounds.terrain !== undefined, false],
      ["path", "drone's path", field.path.length > 1, false],
    ];
    const checks = layers.filter(([, , there]) => there).map(([layer, label, , on]) => {
      this.layers.set(layer, on);
      return checkbox(label, on, (shown) => this.scene?.show(layer, shown));
    });
    const modes = modesOf(field, this.grounds);
    this.mode = modes[0].value;
    const tools = h("div", { class: "tools" });
    if (field.cloud) {
      tools.append(select("Colour", modes, this.mode, (mode) => {
        this.mode = mode as Mode;
        this.colour();
      }));
      const size = h("input", { type: "range", min: 0.5, max: 3, step: 0.1, value: 1, "aria-label": "Point size", input: () => {
        if (this.scene?.cloud) this.scene.cloud.scale = Number(size.value);
        this.scene?.redraw();
      } });
      tools.append(h("label", { class: "choice" }, h("span", {}, "Size"), size));
    }
    tools.append(
      button("Whole field", "Look at the whole field", () => this.scene?.look("overview")),
      button("From above", "Look from straight above", () => this.scene?.look("top")));
    if (field.plots.length > 0) tools.append(button("To the plot", "Look at the selected plot", () => this.scene?.look("plot")));
    tools.append(saveButtons({ title: `${field.name} in 3D`, png: () => this.scene!.png() }));
    return h("div", { class: "head" }, h("h3", {}, "In three dimensions"), tools, h("div", { class: "checks" }, ...checks));
  }

  private readonly layers = new Map<Layer, boolean>();

  private mapTools(): HTMLElement {
    const { field } = this;
    const some = (measure: Measure) => field.plots.some((plot) =>
      heightNames(field).concat(this.heightOrTruth()).some((name) => Number.isFinite(measured(plot, measure, name))));
    const measures = (Object.keys(measureNames) as Measure[]).filter(some);
    if (!measures.includes(this.measure)) this.measure = measures[0] ?? "height";
    const names = heightNames(field);
    const truths = [...new Set(field.plots.flatMap((plot) => Object.keys(plot.truths)))];
    const heights = names.length ? names.map((name) => ({ value: name, label: name })) :
      truths.map((name) => ({ value: name.replace(/^height_|_m$/g, ""), label: truthName(name) }));
    if (!names.length && heights.length) this.height = firstHeight(heights.map(({ value }) => value));
    return h("div", { class: "tools" },
      select("Show", measures.map((measure) => ({ value: measure, label: measureNames[measure] })), this.measure, (measure) => {
        this.measure = measure as Measure;
        this.refresh();
      }),
      heights.length > 1 ? select("Height", heights, this.height, (height) => {
        this.height = height;
        this.refresh();
      }) : null);
  }

  private heightOf(plot: Plot): number {
    return plot.heights[this.height]?.[0] ?? plot.truths[namedTruth(this.height)] ?? NaN;
  }

  private startScene(): void {
    const stage = this.element.querySelector<HTMLElement>("#stage")!;
    try {
      this.scene = new Scene(this.field, this.grounds);
    } catch {
      stage.replaceChildren(h("p", { class: "warning" }, "This browser cannot draw in three dimensions (WebGL 2)."));
      return;
    }
    const { scene } = this;
    scene.canvas.setAttribute("role", "application");
    scene.canvas.setAttribute("aria-label", "The field in three dimensions: arrows turn it, with Shift they move it, + and − zoom, a click selects a plot");
    stage.append(scene.canvas, scene.labels.overlay, this.key);
    scene.onPick = (plot) => plot && this.pick(plot, "scene");
    for (const [layer, shown] of this.layers) scene.show(layer, shown);
    scene.plots((plot) => this.heightOf(plot), this.selected);
    onTheme(stage, () => this.scene?.colours(theme().dark ? "#0d1117" : "#f3f5f7", theme().dark ? "#c9d1d9" : "#1c2128"));
    new ResizeObserver(() => this.scene?.resize(stage.clientWidth, stage.clientHeight)).observe(stage);
    scene.resize(stage.clientWidth, stage.clientHeight);
  }

  private async loadCloud(): Promise<void> {
    const cloud = this.scene?.cloud;
    if (!cloud) {
      this.element.dataset.ready = String(Math.round(performance.now()));
      this.status.textContent = this.field.cloud ? "" : "This page was made without points.";
      return;
    }
    const { shown, read } = cloud.cloud;
    let coloured = 0;
    await cloud.load((done) => {
      this.status.textContent = `Reading points: ${counted(done)} of ${counted(shown)}`;
      if (done > 2 * coloured) {
        coloured = done;
        this.colour();
      }
    });
    if (!this.scene) return;
    this.colour();
    this.profile?.update();
    for (const { update } of this.workings) update();
    this.status.textContent =
      `${counted(shown)} points${read > shown ? `, a fair sample of the ${counted(read)} that were read` : ""}. ` +
      "Drag turns, wheel or pinch zooms, right button or two fingers move; arrows, + and − do the same.";
    this.element.dataset.ready = String(Math.round(performance.now()));
  }

  private colour(): void {
    const cloud = this.scene?.cloud;
    if (!cloud) return;
    const look = lookOf(this.mode, this.field, this.grounds, cloud.read);
    cloud.colour(look.colouring);
    this.key.replaceChildren(keyElement(look.key));
    this.scene?.redraw();
  }

  private refresh(): void {
    this.scene?.plots((plot) => this.heightOf(plot), this.selected);
    this.map?.update();
    this.profile?.update();
    this.showDetails();
  }

  private pick(plot: Plot, from?: "map" | "scene"): void {
    this.selected = plot;
    this.refresh();
    this.table?.select(plot.id);
    if (from === "map") this.element.querySelector<SVGElement>(".map [aria-pressed='true']")?.focus();
  }

  private profileFigure() {
    const plot = this.selected ?? this.field.plots[0];
    const cloud = this.scene?.cloud;
    const { terrain } = this.grounds;
    const ground = groundUnder(plot, this.field, this.grounds);
    const points = cloud ? pointsOver(plot.box, cloud.cloud, cloud.read, (x, y) => (ground ?? terrain)?.height(x, y) ?? NaN) : [];
    const options = { plot, points, ground, terrain, height: this.height, kinds: heightKinds(this.field) };
    return {
      title: `Plot ${plot.id} from the side`,
      note: profileNote(options),
      draw: (colours: Theme, narrow: boolean) => drawProfile(options, colours, narrow),
      csv: () => profileCsv(options),
    };
  }

  private showDetails(): void {
    const plot = this.selected;
    if (!plot) return;
    const trial = plot.trial ? `, trial ${plot.trial}` : "";
    const place = plot.row > 0 ? `${trial}, row ${plot.row}, column ${plot.column}` : trial;
    const [, , width, length, heading] = plot.box;
    const lines: Node[] = [
      h("h4", {}, `Plot ${plot.id}${place}`),
      h("p", { class: "note" }, `${fixed(length, 2)} m × ${fixed(width, 2)} m, heading ${fixed(heading, 1)}°` +
        (plot.points !== undefined ? `, ${counted(plot.points)} points` : "") +
        (plot.confidence !== undefined ? `, confidence ${fixed(plot.confidence, 2)}` : "") +
        (plot.state ? `, ${plot.state === "extra" ? "no true plot" : "found"}` : "")),
    ];
    for (const flag of flagLines(plot)) lines.push(h("p", { class: "warning" }, flag));
    const names = Object.keys(plot.heights);
    const first = profileHeights(plot, this.height);
    const ordered = [...first, ...names.filter((name) => !first.includes(name))];
    const truths = Object.keys(plot.truths);
    const known = ordered.some((name) => Number.isFinite(measured(plot, "truth", name)));
    if (ordered.length > 0) {
      const told = ordered.some((name) => plot.heights[name][2] !== null);
      lines.push(smallTable(["height", "m", ...(told ? ["95 % interval"] : []), ...(known ? ["truth", "error, cm"] : [])], ordered.map((name) => {
        const [value, , low, high] = plot.heights[name];
        const interval = low === null ? "" : `${fixed(low, 3)} – ${fixed(high, 3)}`;
        return [name, fixed(value, 3), ...(told ? [interval] : []),
          ...(known ? [fixed(measured(plot, "truth", name), 3), signed(100 * measured(plot, "error", name), 1)] : [])];
      })));
    }
    if (!known && truths.length > 0) lines.push(smallTable(["truth", "m"], truths.map((name) => [truthName(name), fixed(plot.truths[name], 3)])));
    this.details.replaceChildren(...lines);
  }

  private plotTable(): Table<Plot> {
    const { field } = this;
    const columns = plotColumns(field);
    return new Table({
      title: `Plots of ${field.name}`, columns, note: plotNote(columns), rows: field.plots, key: (plot) => plot.id, pick: (plot) => this.pick(plot) });
  }
}
