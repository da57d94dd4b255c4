// SPDX-License-Identifier: Apache-2.0
/** One aircraft: what it does, its state, and what it may be told to do. */
import { h } from "../../common/dom";
import type { App } from "../app";
import { latLonText } from "../../common/frames";
import { T } from "../../common/texts";
import { button, Facts, icon, iconButton, option, setText } from "../../common/ui";
import { FlightChangeForm } from "./flight_change";
import { TaskFormView } from "./task_form";

/** A term of a decision, for people: "travel_time_s" is "travel time s". */
const reasonName = (name: string) => name.replace(/_/g, " ");
const shortNumber = (value: number) => (Number.isInteger(value) ? String(value) : value.toPrecision(3));

export class AircraftDetail {
  readonly element = h("section", { class: "detail", "aria-labelledby": "detail-name" });
  private readonly title = h("h2", { id: "detail-name" });
  private readonly does = h("p", { class: "does" });
  private readonly facts = new Facts();
  private readonly actions = h("div", { class: "actions" });
  private readonly heir = h("select", { "aria-label": T.task.giveTo, onchange: () => this.give() });
  private readonly form: TaskFormView;
  private readonly flight: FlightChangeForm;
  private readonly hint = h("p", { class: "hint" }, T.fleet.selectHint);
  private readonly content: HTMLElement;

  constructor(private readonly app: App) {
    this.form = new TaskFormView(app);
    this.flight = new FlightChangeForm(app);
    this.actions.append(
      h("button", { type: "button", class: "primary", onclick: () => this.form.toggle() }, T.task.give),
      button(T.task.hold, () => this.each((name) => app.giveTask(name, { kind: "hold" }))),
      button(T.task.return, () => this.each((name) => app.giveTask(name, { kind: "return" }))),
      button(T.task.land, () => this.each((name) => app.giveTask(name, { kind: "land", at_home: true } as never))),
      button(T.task.pauseTask, () => this.change("pause")),
      button(T.task.resumeTask, () => this.change("resume")),
      button(T.task.cancelTask, () => this.change("cancel")),
      button(T.task.heightSpeed, () => this.flight.toggle()),
      this.heir,
    );
    this.content = h(
      "div",
      { class: "detail-content" },
      h(
        "header",
        {},
        this.title,
        iconButton(
          "follow",
          T.aircraft.follow,
          () => {
            app.map.follow = !app.map.follow;
          },
          { "data-follow": "" },
        ),
        iconButton("target", T.aircraft.center, () => {
          for (const id of app.map.selected) {
            app.map.centreOn(id);
            break;
          }
        }),
        iconButton("close", T.aircraft.close, () => app.map.select([])),
      ),
      this.does,
      this.actions,
      this.form.element,
      this.flight.element,
      this.facts.element,
    );
    this.element.append(this.hint, this.content);
  }

  private each(action: (name: string) => void): void {
    for (const id of this.app.map.selected) action(this.app.world.name(id));
  }

  private change(action: "pause" | "resume" | "cancel"): void {
    this.each((aircraft) => this.app.command({ kind: "change_task", aircraft, action }, T.commands.task(aircraft, action)));
  }

  /** Another goes on with what is left of the task. */
  private give(): void {
    const to = this.heir.value;
    this.heir.value = "";
    if (to) this.each((name) => this.app.connection.send({ line: `task ${name} give ${to}` }, T.commands.task(name, `${T.task.giveTo} ${to}`)));
  }

  update(): void {
    const { app } = this,
      { world, units } = app,
      { fleet } = world;
    const ids = [...app.map.selected];
    this.hint.hidden = ids.length > 0;
    this.content.hidden = ids.length === 0;
    if (ids.length === 0) return;
    const id = ids[0],
      row = fleet.row(id);
    setText(this.title, ids.length === 1 ? world.name(id) : T.aircraft.several(ids.length));
    this.content.querySelector("[data-follow]")?.setAttribute("aria-pressed", String(app.map.follow));
    for (const control of this.actions.querySelectorAll<HTMLButtonElement | HTMLSelectElement>("button, select")) control.disabled = !app.mayCommand;
    if (this.heir.options.length !== app.run.aircraft.length + 1)
      this.heir.replaceChildren(option("", T.task.giveTo), ...app.run.aircraft.map(({ name }) => option(name, name)));
    if (row < 0) return;
    const get = (name: string) => fleet.get(row, name),
      f = this.facts;
    const warned = get("failsafe") > 0;
    this.does.className = warned ? "does warned" : "does";
    const doing = ids.length === 1 ? app.doing(row) : ids.map((each) => world.name(each)).join(", ");
    if (this.does.dataset.text !== doing) {
      this.does.dataset.text = doing;
      this.does.replaceChildren(...(warned ? [icon("warning")] : []), doing);
    }
    f.set(T.aircraft.altitude, units.height(get("altitude_msl_m")));
    if (app.terrain) f.set(T.aircraft.overGround, units.height(get("altitude_msl_m") - app.terrain.at(get("north_m"), get("east_m"))));
    f.set(T.aircraft.speed, units.speed(Math.hypot(get("velocity_north_mps"), get("velocity_east_mps"))));
    f.set(T.aircraft.climb, units.climb(get("climb_mps")));
    f.set(T.aircraft.heading, units.angle(get("heading_deg")));
    f.set(T.aircraft.battery, units.percent(get("charge")), get("charge") < 0.2 ? "warned" : "");
    f.set(T.aircraft.endurance, units.seconds(get("endurance_s")));
    const silence = app.silence(row);
    f.set(T.aircraft.heard, T.fleet.age(units.seconds(silence)), silence > 5 ? "warned" : "");
    f.set(T.aircraft.sd, units.distance(get("position_sd_m")));
    f.set(T.aircraft.cross, units.distance(get("cross_track_m")));
    f.set(T.aircraft.late, units.seconds(get("time_error_s")));
    f.set(T.aircraft.mode, fleet.word(row, "mode"));
    f.set(
      T.aircraft.failsafe,
      warned ? (T.task.failsafes[fleet.word(row, "failsafe")] ?? fleet.word(row, "failsafe")) : T.aircraft.allOk,
      warned ? "warned" : "",
    );
    const planner = world.planners.get(id);
    if (planner) f.set("Planner", T.aircraft.planner(planner.link, planner.verdict, planner.reason));
    const reason = world.reasons.get(id);
    if (reason) f.set(T.aircraft.why, reason.terms.map(({ name, value }) => `${reasonName(name)} ${value === null ? T.none : shortNumber(value)}`).join(", "));
    const lead = world.leads.get(id);
    if (lead?.master_id != null) f.set(T.aircraft.leads, T.aircraft.master(world.name(lead.master_id)));
    f.set(T.aircraft.position, latLonText(world.frame.toLatLon(get("north_m"), get("east_m"), get("altitude_msl_m"))));
  }
}
