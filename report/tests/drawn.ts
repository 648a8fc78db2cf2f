// Elements enough for figures to be drawn without a browser; import it before what draws.
export class Drawn {
  readonly attributes: Record<string, string> = {};
  readonly children: (Drawn | string)[] = [];
  constructor(readonly tag: string) {}

  setAttribute(name: string, value: string): void {
    this.attributes[name] = value;
  }

  append(...children: (Drawn | string)[]): void {
    this.children.push(...children);
  }

  addEventListener(): void {}

  all(tag: string): Drawn[] {
    return this.children.flatMap((child) => (typeof child === "string" ? [] : [...(child.tag === tag ? [child] : []), ...child.all(tag)]));
  }

  get words(): string {
    return this.children.map((child) => (typeof child === "string" ? child : child.words)).join("");
  }
}

const element = (_: string, tag: string) => new Drawn(tag);
Object.assign(globalThis, { document: { createElementNS: element }, window: { matchMedia: () => ({ matches: false }) } });

export const drawn = (svg: SVGSVGElement): Drawn => svg as unknown as Drawn;
