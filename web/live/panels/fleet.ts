// SPDX-License-Identifier: Apache-2.0
/** All aircraft: what each does, its battery, when it was heard of. Only the rows that are seen exist. */
import { h } from "../../common/dom";
import type { App } from "../app";
import { T } from "../../common/texts";
import { option, setText } from "../../common/ui";
import { AircraftDetail } from "./aircraft";
import type { Panel } from "./panel";

const kRow = 46; // height [px]
const kCollator = new Intl.Collator(undefined, { numeric: true });

interface Line {
  element: HTMLElement;
  name: HTMLElement;
  kind: HTMLElement;
  does: HTMLElement;
  battery: HTMLElement;
  bar: HTMLElement;
  heard: HTMLElement;
  height: HTMLElement;
  id: number;
}

type Sort = keyof typeof T.fleet.sorts;

export class FleetPanel implements Panel {
  readonly element: HTMLElement;
  readonly search: HTMLInputElement;
  private readonly count = h("p", { class: "count", role: "status" });
  private readonly body = h("div", { class: "fleet-rows", role: "presentation" });
  private readonly scroller: HTMLElement;
  private readonly lines: Line[] = [];
  private readonly detail: AircraftDetail;
  private order: number[] = []; // rows of the fleet
  private sort: Sort = "name";
  private focused = 0;
  private sorted = "";

  constructor(private readonly app: App) {
    this.search = h("input", { type: "search", placeholder: T.fleet.search, "aria-label": T.fleet.search, oninput: () => this.update() });
    const sort = h(
      "select",
      {
        "aria-label": T.fleet.sort,
        onchange: () => {
          this.sort = sort.value as Sort;
          this.update();
        },
      },
      ...Object.entries(T.fleet.sorts).map(([value, text]) => option(value, text)),
    );
    this.scroller = h(
      "div",
      {
        class: "fleet-scroll",
        role: "listbox",
        "aria-label": T.fleet.title,
        "aria-multiselectable": "true",
        tabindex: 0,
        onscroll: () => this.fill(),
        onkeydown: (event) => this.key(event as KeyboardEvent),
      },
      this.body,
    );
    this.detail = new AircraftDetail(app);
    this.element = h("div", { class: "fleet-panel" }, h("div", { class: "bar" }, this.search, sort), this.count, this.scroller, this.detail.element);
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8, Home: -1e9, End: 1e9 }[event.key];
    if (step === undefined || this.order.length === 0) return;
    event.preventDefault();
    event.stopPropagation();
    const now = this.order.findIndex((row) => this.app.map.selected.has(this.app.world.fleet.ids[row]));
    this.focused = Math.max(0, Math.min(this.order.length - 1, now + step));
    this.app.map.select([this.app.world.fleet.ids[this.order[this.focused]]]);
    this.reveal(this.focused);
  }

  private reveal(index: number): void {
    const top = index * kRow,
      s = this.scroller;
    if (top < s.scrollTop) s.scrollTop = top;
    else if (top + kRow > s.scrollTop + s.clientHeight) s.scrollTop = top + kRow - s.clientHeight;
    this.fill();
  }

  /** The next or previous aircraft of the list is chosen. */
  step(by: number): void {
    const now = this.order.findIndex((row) => this.app.map.selected.has(this.app.world.fleet.ids[row]));
    if (this.order.length === 0) this.sortRows();
    if (this.order.length === 0) return;
    const next = (now + by + this.order.length) % this.order.length;
    this.app.map.select([this.app.world.fleet.ids[this.order[now < 0 ? 0 : next]]]);
    this.reveal(now < 0 ? 0 : next);
  }

  private sortRows(): void {
    const { fleet, entities } = this.app.world,
      wanted = this.search.value.trim().toLowerCase();
    const rows: number[] = [];
    for (let row = 0; row < fleet.count; ++row) if (!wanted || (entities.get(fleet.ids[row])?.name ?? "").toLowerCase().includes(wanted)) rows.push(row);
    const name = (row: number) => this.app.world.name(fleet.ids[row]);
    if (this.sort === "name" && this.sorted === `${fleet.count} ${this.app.world.version.entities} ${wanted}`) return;
    this.sorted = this.sort === "name" ? `${fleet.count} ${this.app.world.version.entities} ${wanted}` : "";
    const charge = (row: number) => {
      const c = fleet.get(row, "charge");
      return Number.isFinite(c) ? c : 2;
    };
    const attention = (row: number) => (fleet.get(row, "failsafe") > 0 ? 0 : 1e3) + (this.app.silence(row) > 5 ? 0 : 100) + 10 * Math.min(charge(row), 1);
    const by: Record<string, (a: number, b: number) => number> = {
      name: (a, b) => kCollator.compare(name(a), name(b)),
      battery: (a, b) => charge(a) - charge(b),
      heard: (a, b) => this.app.silence(b) - this.app.silence(a),
      attention: (a, b) => attention(a) - attention(b),
    };
    this.order = rows.sort(by[this.sort]);
  }

  update(): void {
    const { fleet } = this.app.world;
    this.sortRows();
    let warned = 0;
    for (let row = 0; row < fleet.count; ++row) if (fleet.get(row, "failsafe") > 0) ++warned;
    setText(this.count, fleet.count === 0 ? T.fleet.empty : T.fleet.count(fleet.count, warned));
    const height = `${this.order.length * kRow}px`;
    if (this.body.style.height !== height) this.body.style.height = height;
    this.fill();
    this.detail.update();
  }

  private line(index: number): Line {
    let line = this.lines[index];
    if (line) return line;
    const part = (name: string) => h("span", { class: name });
    const bar = part("charge-fill");
    line = {
      element: h("div", { class: "fleet-row", role: "option" }),
      name: part("name"),
      kind: part("kind"),
      does: part("does"),
      battery: part("battery"),
      bar,
      heard: part("heard"),
      height: part("height"),
      id: -1,
    };
    const made = line;
    made.element.append(
      part("swatch"),
      h("span", { class: "who" }, made.name, made.kind),
      made.does,
      h("span", { class: "charge" }, h("span", { class: "charge-bar" }, bar), made.battery),
      made.height,
      made.heard,
    );
    made.element.addEventListener("click", (event) => {
      const { map } = this.app;
      if (event.shiftKey || event.ctrlKey)
        map.select(map.selected.has(made.id) ? [...map.selected].filter((id) => id !== made.id) : [...map.selected, made.id]);
      else map.select([made.id]);
      this.fill();
    });
    made.element.addEventListener("dblclick", () => this.app.map.centreOn(made.id));
    this.body.append(made.element);
    return (this.lines[index] = made);
  }

  // Shows the rows that are seen; the elements are used again.
  private fill(): void {
    const { app } = this,
      { fleet } = app.world,
      { units } = app;
    const first = Math.max(0, Math.floor(this.scroller.scrollTop / kRow));
    const seen = Math.ceil((this.scroller.clientHeight || 400) / kRow) + 1;
    const last = Math.min(this.order.length, first + seen);
    for (let i = first; i < last; ++i) {
      const row = this.order[i],
        id = fleet.ids[row],
        line = this.line(i - first);
      line.id = id;
      line.element.hidden = false;
      const top = `translateY(${i * kRow}px)`;
      if (line.element.style.transform !== top) line.element.style.transform = top;
      setText(line.name, app.world.name(id));
      const reality = app.reality(id);
      setText(line.kind, reality === "simulated" ? "" : T.fleet.real[reality]);
      setText(line.does, app.doing(row));
      const warned = fleet.get(row, "failsafe") > 0,
        silence = app.silence(row),
        charge = fleet.get(row, "charge");
      setText(line.battery, units.percent(charge));
      line.bar.style.width = `${Math.max(0, Math.min(100, 100 * (charge || 0)))}%`;
      setText(line.heard, silence > 1.5 ? T.fleet.age(units.seconds(silence)) : "");
      setText(line.height, `${units.height(fleet.get(row, "altitude_msl_m"))}`);
      const swatch = fleet.count <= 8 ? ` c${row % 8}` : " plain";
      const kind = `fleet-row${warned ? " warned" : ""}${silence > 5 ? " old" : ""}${charge < 0.2 ? " low" : ""}${swatch}`;
      if (line.element.className !== kind) line.element.className = kind;
      line.element.setAttribute("aria-selected", String(app.map.selected.has(id)));
    }
    for (let i = Math.max(0, last - first); i < this.lines.length; ++i) this.lines[i].element.hidden = true;
  }
}
