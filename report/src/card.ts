// A figure with its title, what it shows, and its files.
import { light, type Theme } from "./colours";
import { h } from "./dom";
import { saveButtons } from "./save";
import { onTheme, theme } from "./theme";

export interface Figure {
  title: string;
  note: string;
  draw: (theme: Theme) => SVGSVGElement;
  csv: () => string;
}

export interface Card {
  element: HTMLElement;
  update: () => void;
}

// `figure` is asked anew at every update.
export function card(figure: () => Figure): Card {
  const title = h("h3");
  const note = h("p", { class: "note" });
  const place = h("div", { class: "drawing" });
  const saves = h("div", { class: "tools" });
  const element = h("figure", { class: "card" }, h("div", { class: "head" }, title, saves), place, h("figcaption", {}, note));
  const update = () => {
    const now = figure();
    title.textContent = now.title;
    note.textContent = now.note;
    place.replaceChildren(now.draw(theme()));
    saves.replaceChildren(saveButtons({ title: now.title, svg: () => figure().draw(light), csv: () => figure().csv() }));
  };
  onTheme(update);
  return { element, update };
}
