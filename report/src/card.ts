// A figure with its title, what it shows, and its files.
import { light, type Theme } from "./colours";
import { h } from "./dom";
import { saveButtons } from "./save";
import { onTheme, theme } from "./theme";

export interface Figure {
  title: string;
  note: string;
  draw: (theme: Theme, narrow: boolean) => SVGSVGElement; // narrow: for a phone
  csv: () => string;
}

export interface Card {
  element: HTMLElement;
  update: () => void;
}

const kNarrow_px = 600;

// `figure` is asked anew at every update.
export function card(figure: () => Figure): Card {
  const title = h("h3");
  const note = h("p", { class: "note" });
  const place = h("div", { class: "drawing" });
  const saves = h("div", { class: "tools" });
  const element = h("figure", { class: "card" }, h("div", { class: "head" }, title, saves), place, h("figcaption", {}, note));
  let narrow = window.innerWidth < kNarrow_px;
  const update = () => {
    const now = figure();
    title.textContent = now.title;
    note.textContent = now.note;
    const svg = now.draw(theme(), narrow);
    // What is too wide for a phone scrolls.
    if (narrow && svg.width.baseVal.value > 480) svg.style.minWidth = `${0.75 * svg.width.baseVal.value}px`;
    place.replaceChildren(svg);
    saves.replaceChildren(saveButtons({ title: now.title, svg: () => figure().draw(light, false), csv: () => figure().csv() }));
  };
  onTheme(element, update);
  new ResizeObserver(() => {
    if (narrow === window.innerWidth < kNarrow_px) return;
    narrow = !narrow;
    update();
  }).observe(element);
  return { element, update };
}
