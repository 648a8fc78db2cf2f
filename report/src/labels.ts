// The plots' numbers over their boxes.
import * as THREE from "three";
import type { Plot } from "./data";
import type { Place } from "./place";

const kMost = 120; // of more plots the chosen one alone has its number

export class Labels {
  readonly overlay = document.createElement("div");
  private labels: { element: HTMLElement; at: THREE.Vector3 }[] = [];

  constructor(private readonly place: Place) {
    this.overlay.className = "labels";
  }

  write(selected?: Plot): void {
    const { place } = this;
    const plots = place.field.plots.length <= kMost ? place.field.plots : selected ? [selected] : [];
    this.labels = plots.map((plot) => {
      const [x, y] = plot.box;
      const element = document.createElement("span");
      element.textContent = plot.id.length > 14 ? plot.id.slice(0, 13) + "…" : plot.id;
      if (plot === selected) element.className = "selected";
      return { element, at: place.local(x, y, place.groundAt(x, y) + place.tall(plot) + 0.15) };
    });
    this.overlay.replaceChildren(...this.labels.map((label) => label.element));
  }

  follow(camera: THREE.Camera, { clientWidth, clientHeight }: HTMLElement): void {
    if (this.overlay.hidden) return;
    for (const { element, at } of this.labels) {
      const seen = at.clone().project(camera);
      const visible = Math.abs(seen.x) < 1 && Math.abs(seen.y) < 1 && seen.z < 1;
      element.hidden = !visible;
      const [left, top] = [((seen.x + 1) / 2) * clientWidth, ((1 - seen.y) / 2) * clientHeight];
      if (visible) element.style.transform = `translate(${left}px, ${top}px) translate(-50%, -100%)`;
    }
  }
}
