// SPDX-License-Identifier: Apache-2.0
/** What only the instructor does: faults, wind, truth, who flies, time, training. */
import { h } from "../../common/dom";
import type { App } from "../app";
import { T } from "../../common/texts";
import { button, labelledField, option } from "../../common/ui";
import type { Panel } from "./panel";

export class InstructorPanel implements Panel {
  readonly element = h("div", { class: "panel" });
  private readonly aircraft = h("select", {});
  private readonly content: HTMLFieldSetElement;
  private readonly only = h("p", { class: "hint" }, T.instructor.only);
  private truthShown = true;
  private readonly truth: HTMLButtonElement;
  private readonly ladder = h("ol", { class: "ladder" });
  private rung = 0;
  private shown = "";

  constructor(private readonly app: App) {
    const part = h("input", { type: "text", list: "parts", value: "link" });
    const parts = h("datalist", { id: "parts" }, ...T.instructor.parts.map((each) => option(each, each)));
    const speed = h("input", { type: "number", min: 0, max: 60, step: "any", value: 5 });
    const from = h("input", { type: "number", min: 0, max: 359, step: 1, value: 270 });
    const steps = h("input", { type: "number", min: 1, step: 1, value: 10 });
    const line = h("input", { type: "text", placeholder: "wind 5 270", spellcheck: "false" });
    this.truth = button("", () => this.setTruth(!this.truthShown));
    this.ladder.append(
      ...T.instructor.rungs.map((text, k) =>
        h(
          "li",
          {},
          button(text, () => this.climb(k)),
        ),
      ),
    );
    this.content = h(
      "fieldset",
      { class: "panel-content" },
      h("section", {}, h("h3", {}, T.instructor.truth), h("div", { class: "actions" }, this.truth)),
      h(
        "section",
        {},
        h("h3", {}, T.instructor.faults),
        h("div", { class: "two" }, labelledField(T.task.who, this.aircraft), labelledField(T.instructor.part, part)),
        parts,
        h(
          "div",
          { class: "actions" },
          button(T.instructor.inject, () => this.fault(this.aircraft.value, part.value, true), { class: "danger" }),
          button(T.instructor.repair, () => this.fault(this.aircraft.value, part.value, false)),
          button(T.instructor.add, () => app.command({ kind: "add", aircraft: this.aircraft.value }, T.commands.add(this.aircraft.value))),
          button(T.instructor.remove, () => app.command({ kind: "remove", aircraft: this.aircraft.value }, T.commands.remove(this.aircraft.value)), {
            class: "danger",
          }),
        ),
      ),
      h(
        "section",
        {},
        h("h3", {}, T.instructor.wind),
        h("div", { class: "two" }, labelledField(T.instructor.speed, speed, "m/s"), labelledField(T.instructor.from, from, "deg")),
        h(
          "div",
          { class: "actions" },
          button(T.instructor.setWind, () => this.wind(Number(speed.value), Number(from.value))),
          button(T.instructor.noWind, () => this.wind(0, 0)),
        ),
      ),
      h(
        "section",
        {},
        h("h3", {}, T.instructor.time),
        h(
          "div",
          { class: "actions" },
          labelledField(T.instructor.steps, steps),
          button(T.top.step, () => app.step(Math.max(1, Math.round(Number(steps.value))))),
        ),
      ),
      h("section", {}, h("h3", {}, T.instructor.ladder), h("p", { class: "hint" }, T.instructor.ladderHint), this.ladder),
      h(
        "section",
        {},
        h("h3", {}, T.instructor.line),
        h(
          "form",
          {
            class: "line-form",
            onsubmit: (event) => {
              event.preventDefault();
              if (line.value.trim()) app.connection.send({ line: line.value.trim() }, line.value.trim());
              line.value = "";
            },
          },
          labelledField(T.instructor.line, line, "", T.instructor.lineHint),
          h("button", { type: "submit" }, T.instructor.send),
        ),
      ),
    );
    this.element.append(this.only, this.content);
  }

  private setTruth(shown: boolean): void {
    this.truthShown = shown;
    this.app.connection.send({ truth: shown }, T.commands.truth(shown));
    this.update();
  }

  private fault(aircraft: string, part: string, fails: boolean): void {
    this.app.command({ kind: "fault", aircraft, part, fails }, fails ? T.commands.fault(aircraft, part) : T.commands.repair(aircraft, part));
  }

  /** Wind blows from a direction. */
  private wind(speed: number, from: number): void {
    const a = (from * Math.PI) / 180;
    this.app.command({ kind: "wind", wind_north_mps: -speed * Math.cos(a), wind_east_mps: -speed * Math.sin(a) }, T.commands.wind);
  }

  // Sets up all steps up to this one.
  private climb(rung: number): void {
    const name = this.aircraft.value;
    this.setTruth(rung < 1);
    this.wind(rung >= 2 ? 6 : 0, 225);
    this.fault(name, "link", rung >= 3);
    if (rung >= 4 || this.rung >= 4) this.fault(name, "motor", rung >= 4);
    this.rung = rung;
    [...this.ladder.querySelectorAll("button")].forEach((each, k) => each.setAttribute("aria-pressed", String(k <= rung)));
  }

  update(): void {
    const may = this.app.role === "instructor",
      key = `${this.app.world.version.entities} ${may} ${this.truthShown}`;
    if (key === this.shown) return;
    this.shown = key;
    this.only.hidden = may;
    this.content.disabled = !may;
    this.truth.textContent = this.truthShown ? T.instructor.hideTruth : T.instructor.showTruth;
    const names = this.app.run.aircraft;
    if (this.aircraft.options.length !== names.length)
      this.aircraft.replaceChildren(...names.map(({ name, joins_later }) => option(name, joins_later ? `${name} (${T.fleet.add})` : name)));
  }
}
