// Light or dark, as the reader's system has it or as the reader says.
import { dark, light, type Theme } from "./colours";
import { select } from "./dom";

const system = window.matchMedia("(prefers-color-scheme: dark)");
let chosen = "auto";
const listeners = new Map<() => void, Element>();

export const theme = (): Theme => ((chosen === "auto" ? system.matches : chosen === "dark") ? dark : light);

// Calls now and whenever the colours change, as long as the element is on the page.
export function onTheme(element: Element, draw: () => void): void {
  listeners.set(draw, element);
  draw();
}

function changed(): void {
  document.documentElement.dataset.theme = theme().dark ? "dark" : "light";
  for (const [draw, element] of listeners) {
    if (element.isConnected) draw();
    else listeners.delete(draw);
  }
}

export function themeChoice(): HTMLElement {
  system.addEventListener("change", changed);
  changed();
  return select("Colours", [
    { value: "auto", label: "as the system" }, { value: "light", label: "light" }, { value: "dark", label: "dark" },
  ], chosen, (value) => {
    chosen = value;
    changed();
  });
}
