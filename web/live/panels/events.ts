// SPDX-License-Identifier: Apache-2.0
/** Events with filters, and what became of the commands that were given here. */
import { clock, h } from "../../common/dom";
import { eventKind, isBad } from "../../common/events";
import type { App } from "../app";
import { T } from "../../common/texts";
import { option, setText } from "../../common/ui";
import type { KeptEvent } from "../../common/world";
import type { Panel } from "./panel";

const kRow = 40,
  kKinds = 200;

interface Line {
  element: HTMLElement;
  time: HTMLElement;
  who: HTMLElement;
  what: HTMLElement;
  event: KeptEvent | null;
}

export class EventsPanel implements Panel {
  readonly element: HTMLElement;
  private readonly kind = h("select", { "aria-label": T.events.filter, onchange: () => this.update() }, option("", T.events.all));
  private readonly who = h("select", { "aria-label": T.events.all, onchange: () => this.update() }, option("", T.events.who));
  private readonly text = h("input", { type: "search", placeholder: T.events.filter, "aria-label": T.events.filter, oninput: () => this.update() });
  private readonly count = h("p", { class: "count", role: "status" });
  private readonly body = h("div", { class: "event-rows", role: "presentation" });
  private readonly scroller = h(
    "div",
    { class: "event-scroll", role: "list", "aria-label": T.events.title, tabindex: 0, onscroll: () => this.fill() },
    this.body,
  );
  private readonly commands = h("ul", { class: "commands" });
  private readonly lines: Line[] = [];
  private list: KeptEvent[] = [];
  private shown = "";
  private commandsShown = "";

  constructor(private readonly app: App) {
    this.element = h(
      "div",
      { class: "events-panel" },
      h("div", { class: "bar three" }, this.text, this.kind, this.who),
      this.count,
      this.scroller,
      h("section", { class: "sent", "aria-label": T.events.commands }, h("h3", {}, T.events.commands), this.commands),
    );
  }

  private fillChoices(): void {
    const { events, entities } = this.app.world;
    const add = (select: HTMLSelectElement, values: [string, string][]) => {
      const known = new Set([...select.options].map(({ value }) => value));
      for (const [value, text] of values)
        if (!known.has(value) && known.size < kKinds) {
          known.add(value);
          select.append(option(value, text));
        }
    };
    add(
      this.kind,
      [...new Set(events.slice(-300).map(({ kind }) => kind))].sort().map((kind) => [kind, kind]),
    );
    add(
      this.who,
      [...entities.values()].map(({ entity_id, name }) => [String(entity_id), name]),
    );
  }

  update(): void {
    this.showCommands();
    const wanted = this.text.value.trim().toLowerCase(),
      { world } = this.app;
    const key = `${world.version.events} ${world.version.entities} ${wanted} ${this.kind.value} ${this.who.value}`;
    if (key === this.shown) return this.fill();
    this.shown = key;
    this.fillChoices();
    this.list = world.events
      .filter(
        (e) =>
          (!this.kind.value || e.kind === this.kind.value) &&
          (!this.who.value || String(e.entity_id) === this.who.value) &&
          (!wanted || `${e.kind} ${e.text} ${world.whose(e)}`.toLowerCase().includes(wanted)),
      )
      .reverse();
    setText(this.count, this.list.length === 0 ? T.events.none : T.events.more(this.list.length));
    this.body.style.height = `${this.list.length * kRow}px`;
    this.fill();
  }

  private line(index: number): Line {
    const known = this.lines[index];
    if (known) return known;
    const line: Line = {
      element: h("div", { class: "event-row", role: "listitem" }),
      time: h("span", { class: "time" }),
      who: h("span", { class: "who" }),
      what: h("span", { class: "what" }),
      event: null,
    };
    const jump = h(
      "button",
      {
        type: "button",
        class: "event-jump",
        onclick: () => {
          if (line.event) this.app.jumpTo(line.event);
        },
      },
      line.time,
      line.who,
      line.what,
    );
    jump.title = T.events.jump;
    line.element.append(jump);
    this.body.append(line.element);
    return (this.lines[index] = line);
  }

  private fill(): void {
    const first = Math.max(0, Math.floor(this.scroller.scrollTop / kRow)),
      seen = Math.ceil((this.scroller.clientHeight || 300) / kRow) + 1;
    const last = Math.min(this.list.length, first + seen);
    for (let i = first; i < last; ++i) {
      const event = this.list[i],
        line = this.line(i - first);
      line.event = event;
      line.element.hidden = false;
      const top = `translateY(${i * kRow}px)`;
      if (line.element.style.transform !== top) line.element.style.transform = top;
      setText(line.time, clock(event.time_s));
      setText(line.who, this.app.world.whose(event));
      setText(line.what, `${event.kind}: ${event.text}`);
      line.what.title = `${event.text}\n${eventKind(event.kind).meaning}`;
      line.element.classList.toggle("bad", isBad(event.kind));
    }
    for (let i = Math.max(0, last - first); i < this.lines.length; ++i) this.lines[i].element.hidden = true;
  }

  private showCommands(): void {
    const { sent } = this.app.connection,
      key = sent
        .slice(0, 30)
        .map(({ number, state }) => number + state)
        .join();
    if (key === this.commandsShown && this.commandsShown !== "") return;
    this.commandsShown = key;
    this.commands.replaceChildren(
      ...(sent.length === 0
        ? [h("li", { class: "hint" }, T.events.noCommands)]
        : sent
            .slice(0, 30)
            .map((each) =>
              h(
                "li",
                {},
                h("span", { class: "what" }, each.text, each.reason ? h("em", {}, ` ${each.reason}`) : null),
                h("span", { class: `fate ${each.state}` }, T.events.states[each.state]),
              ),
            )),
    );
  }
}
