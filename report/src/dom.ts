// Elements with text: nothing here ever parses HTML, so that labels are shown as they are.

type Child = Node | string | null | undefined;
type Attributes = Record<string, string | number | boolean | EventListener | undefined>;

function fill(element: Element, attributes: Attributes, children: Child[]): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name, value);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
  for (const child of children) if (child !== null && child !== undefined) element.append(child);
}

export function h<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[Tag] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

export function s<Tag extends keyof SVGElementTagNameMap>(
  tag: Tag, attributes: Attributes = {}, ...children: Child[]): SVGElementTagNameMap[Tag] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  fill(element, attributes, children);
  return element;
}

export interface Choice {
  value: string;
  label: string;
}

export function select(
  label: string, choices: Choice[], value: string, changed: (value: string) => void): HTMLLabelElement {
  const box = h("select", { change: () => changed(box.value) },
    ...choices.map((choice) => h("option", { value: choice.value }, choice.label)));
  box.value = value;
  return h("label", { class: "choice" }, h("span", {}, label), box);
}

export function checkbox(label: string, value: boolean, changed: (value: boolean) => void): HTMLLabelElement {
  const box = h("input", { type: "checkbox", change: () => changed(box.checked) });
  box.checked = value;
  return h("label", { class: "check" }, box, h("span", {}, label));
}

export function button(label: string, title: string, pressed: () => void): HTMLButtonElement {
  return h("button", { type: "button", title, click: pressed }, label);
}
