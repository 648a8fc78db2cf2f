// What a reader takes home: figures as SVG and PNG, tables as CSV.
import { button, h } from "./dom";

export function fileName(title: string, extension: string): string {
  const words = title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-+|-+$/g, "").slice(0, 60);
  return `${words || "plotscan"}.${extension}`;
}

export function save(blob: Blob, name: string): void {
  const url = URL.createObjectURL(blob);
  const link = h("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

export const svgText = (svg: SVGSVGElement): string =>
  '<?xml version="1.0" encoding="UTF-8"?>\n' + new XMLSerializer().serializeToString(svg);

// The figure in print's resolution, 300 dots an inch.
async function pngOf(svg: SVGSVGElement): Promise<Blob> {
  const factor = 300 / 96;
  const picture = new Image();
  const loaded = new Promise<void>((done, failed) => {
    picture.onload = () => done();
    picture.onerror = () => failed(new Error("the browser cannot draw this figure"));
  });
  picture.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(svgText(svg));
  await loaded;
  const canvas = h("canvas");
  canvas.width = Math.round(svg.width.baseVal.value * factor);
  canvas.height = Math.round(svg.height.baseVal.value * factor);
  canvas.getContext("2d")!.drawImage(picture, 0, 0, canvas.width, canvas.height);
  return new Promise((done, failed) =>
    canvas.toBlob((blob) => (blob ? done(blob) : failed(new Error("no picture"))), "image/png"));
}

export interface Saved {
  title: string;
  svg?: () => SVGSVGElement;
  png?: () => Promise<Blob>;
  csv?: () => string;
}

export function saveButtons({ title, svg, png, csv }: Saved): HTMLElement {
  const buttons: HTMLElement[] = [];
  if (svg)
    buttons.push(button("SVG", `Save “${title}” as SVG`, () =>
      save(new Blob([svgText(svg())], { type: "image/svg+xml" }), fileName(title, "svg"))));
  const picture = png ?? (svg ? () => pngOf(svg()) : undefined);
  if (picture)
    buttons.push(button("PNG", `Save “${title}” as PNG`, async () => save(await picture(), fileName(title, "png"))));
  if (csv)
    buttons.push(button("CSV", `Save the numbers of “${title}” as CSV`, () =>
      save(new Blob([csv()], { type: "text/csv" }), fileName(title, "csv"))));
  return h("span", { class: "saves" }, ...buttons);
}
