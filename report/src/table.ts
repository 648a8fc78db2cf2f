// Sortable tables.
import { button, h } from "./dom";
import { counted, csv, fixed, signed } from "./numbers";
import { saveButtons } from "./save";

type Value = string | number | null | undefined;

export interface Column<Row> {
  title: string;
  unit?: string;
  hint?: string;
  value: (row: Row) => Value;
  shown?: (row: Row) => string; // else the value as it is
  csv?: [name: string, value: (row: Row) => Value][]; // its columns in the CSV, else one of its title and value
}

const named = (title: string, unit?: string): string => (unit ? `${title} (${unit})` : title);

// Metres as centimetres.
export const centimetres = <Row>(
  title: string, metres: (row: Row) => number, { digits = 2, sign = false, hint }: { digits?: number; sign?: boolean; hint?: string } = {}): Column<Row> =>
  ({ title, unit: "cm", hint, value: (row) => 100 * metres(row), shown: (row) => (sign ? signed : fixed)(100 * metres(row), digits) });

// The 95 % interval of a column of centimetres.
export function intervalColumn<Row>(of: string, low: (row: Row) => number, high: (row: Row) => number): Column<Row> {
  const ends = { low: (row: Row) => 100 * low(row), high: (row: Row) => 100 * high(row) };
  return {
    title: "95 % interval", unit: "cm", hint: "bootstrap over farms", value: ends.high,
    shown: (row) => (Number.isFinite(low(row)) ? `${fixed(ends.low(row), 2)} – ${fixed(ends.high(row), 2)}` : ""),
    csv: [[named(`${of} low`, "cm"), ends.low], [named(`${of} high`, "cm"), ends.high]] };
}

export function tableCsv<Row>(columns: Column<Row>[], rows: Row[]): string {
  const all = columns.flatMap(({ title, unit, value, csv }) => csv ?? [[named(title, unit), value] as const]);
  return csv([all.map(([name]) => name), ...rows.map((row) => all.map(([, value]) => value(row)))]);
}

export interface TableOptions<Row> {
  title: string;
  note?: string;
  columns: Column<Row>[];
  rows: Row[];
  key?: (row: Row) => string;
  pick?: (row: Row) => void;
}

const kFirst = 60;

export class Table<Row> {
  readonly element: HTMLElement;
  private readonly body = h("tbody");
  private readonly heads: HTMLTableCellElement[];
  private readonly more = h("p", { class: "note" });
  private sorted = -1;
  private descending = false;
  private all = false;
  private selected?: string;

  constructor(private options: TableOptions<Row>) {
    this.heads = options.columns.map((column, i) =>
      h("th", { scope: "col", title: column.hint, class: this.isNumber(column) ? "number" : undefined },
        button(column.unit ? `${column.title}, ${column.unit}` : column.title, "Sort by this", () => this.sort(i))));
    this.element = h("section", { class: "card table" },
      h("div", { class: "head" }, h("h3", {}, options.title), h("div", { class: "tools" },
        saveButtons({ title: options.title, csv: () => tableCsv(options.columns, this.ordered()) }))),
      h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": options.title },
        h("table", {}, h("thead", {}, h("tr", {}, ...this.heads)), this.body)),
      this.more);
    if (options.note) this.element.append(h("p", { class: "note" }, options.note));
    this.fill();
  }

  rows(rows: Row[]): void {
    this.options.rows = rows;
    this.fill();
  }

  select(key: string | undefined): void {
    this.selected = key;
    this.fill();
    const row = this.body.querySelector<HTMLElement>("tr.selected");
    const scroll = row?.closest<HTMLElement>(".scroll");
    if (row && scroll) scroll.scrollTop = row.offsetTop - scroll.clientHeight / 2;
  }

  private isNumber(column: Column<Row>): boolean {
    return this.options.rows.some((row) => typeof column.value(row) === "number");
  }

  private sort(i: number): void {
    this.descending = this.sorted === i ? !this.descending : this.isNumber(this.options.columns[i]);
    this.sorted = i;
    this.heads.forEach((head, k) =>
      k === i ? head.setAttribute("aria-sort", this.descending ? "descending" : "ascending") : head.removeAttribute("aria-sort"));
    this.fill();
  }

  private ordered(): Row[] {
    if (this.sorted < 0) return this.options.rows;
    const { value } = this.options.columns[this.sorted];
    const sign = this.descending ? -1 : 1;
    const missing = (of: Value) => of === null || of === undefined || Number.isNaN(of);
    return [...this.options.rows].sort((a, b) => {
      const [x, y] = [value(a), value(b)];
      if (missing(x) || missing(y)) return Number(missing(x)) - Number(missing(y));
      if (typeof x === "number" && typeof y === "number") return sign * (x - y);
      return sign * String(x).localeCompare(String(y), "en", { numeric: true });
    });
  }

  private fill(): void {
    const { columns, key, pick } = this.options;
    const ordered = this.ordered();
    const at = key && this.selected !== undefined ? ordered.findIndex((row) => key(row) === this.selected) : -1;
    const shown = this.all || at >= kFirst ? ordered : ordered.slice(0, kFirst);
    const numbers = columns.map((column) => this.isNumber(column));
    this.body.replaceChildren(...shown.map((row) => {
      const cells = columns.map((column, i) => {
        const value = column.value(row);
        const words = column.shown ? column.shown(row) : value === null || value === undefined ? "" : String(value);
        return h("td", { class: numbers[i] ? "number" : undefined },
          i === 0 && pick ? button(words, "Show this plot", () => pick(row)) : words);
      });
      const selected = key !== undefined && this.selected !== undefined && key(row) === this.selected;
      return h("tr", { class: selected ? "selected" : undefined, click: pick ? () => pick(row) : undefined }, ...cells);
    }));
    this.more.replaceChildren();
    if (shown.length < ordered.length)
      this.more.append(`${counted(shown.length)} of ${counted(ordered.length)} rows. `, button("Show all", "Show every row", () => {
        this.all = true;
        this.fill();
      }));
  }
}
