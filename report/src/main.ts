import "./style.css";
import { readReport, type Report } from "./data";
import { h } from "./dom";
import { estimateFigures } from "./estimate";
import { FieldView } from "./field_view";
import { SuiteView } from "./suite";
import { SweepView } from "./sweep";
import { themeChoice } from "./theme";

function header(report: Report): HTMLElement {
  return h("header", {}, h("div", {}, h("h1", {}, report.title), h("p", { class: "note" }, `Plotscan ${report.plotscan}`)), themeChoice());
}

// A tab for each field; a field's points are read when it is first looked at.
function fieldsSection(report: Report): HTMLElement {
  const place = h("div", { class: "place" });
  let view: FieldView | undefined;
  const open = (i: number) => {
    view?.close();
    view = new FieldView(report.fields[i]);
    place.replaceChildren(view.element);
    void view.open();
  };
  const section = h("section", { id: "fields", "aria-label": "Fields" });
  if (report.kind === "suite") section.append(h("h2", {}, "One farm of each case"));
  if (report.fields.length > 1) {
    section.append(tabList(report.fields.map(({ name }) => name), place, open));
  }
  section.append(place);
  open(0);
  return section;
}

// Tabs of one panel: the arrow keys go from one to the next (WAI-ARIA Authoring Practices, tabs).
function tabList(names: string[], panel: HTMLElement, open: (i: number) => void): HTMLElement {
  panel.id = "panel";
  panel.setAttribute("role", "tabpanel");
  const choose = (chosen: number): void => {
    tabs.forEach((tab, i) => {
      tab.setAttribute("aria-selected", i === chosen ? "true" : "false");
      tab.tabIndex = i === chosen ? 0 : -1;
    });
    open(chosen);
  };
  const tabs = names.map((name, i) => h("button", {
    type: "button", role: "tab", "aria-controls": panel.id, "aria-selected": i === 0 ? "true" : "false", tabindex: i === 0 ? "0" : "-1",
    click: () => choose(i),
    keydown: (event: Event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[(event as KeyboardEvent).key];
      if (step === undefined) return;
      const next = (i + step + tabs.length) % tabs.length;
      choose(next);
      tabs[next].focus();
    } }, name));
  return h("div", { class: "tabs", role: "tablist" }, ...tabs);
}

function sections(report: Report): HTMLElement[] {
  const all: HTMLElement[] = [];
  if (report.fields.length > 0) all.push(fieldsSection(report));
  if (report.suite) all.push(...(report.suite.sweep ? new SweepView(report.suite) : new SuiteView(report.suite)).sections);
  const figures = report.kind === "estimate" ? estimateFigures(report.fields[0]) : undefined;
  if (figures) all.push(figures);
  return all.length > 1 ? [links(all), ...all] : all;
}

// Links to the page's sections.
function links(all: HTMLElement[]): HTMLElement {
  const names: Record<string, string> = { fields: "In three dimensions", figures: "Figures", tables: "Tables" };
  return h("nav", { "aria-label": "Sections" }, ...all.map((section) => h("a", { href: `#${section.id}` }, names[section.id])));
}

function start(): void {
  const page = document.getElementById("page")!;
  try {
    const report = readReport();
    document.title = report.title;
    page.append(header(report));
    page.append(...sections(report));
    if (report.kind === "suite" && !report.suite?.sweep && report.fields.length === 0)
      page.append(h("p", { class: "note" }, "These results have no views of their farms: farmbench run makes them, and shows one farm of each case in three dimensions."));
    if (report.fields.length === 0) document.documentElement.dataset.ready = String(Math.round(performance.now()));
    document.documentElement.dataset.interactive = String(Math.round(performance.now()));
  } catch (error) {
    page.append(h("p", { class: "warning" }, `This page cannot be shown: ${error instanceof Error ? error.message : String(error)}`));
  }
}

start();
