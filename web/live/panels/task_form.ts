// SPDX-License-Identifier: Apache-2.0
/** A form for any kind of task, made from its description: a plugin's kind has one too. */
import { clock, h } from "../../common/dom";
import type { App } from "../app";
import type { TaskField, TaskForm } from "../../common/protocol";
import { T } from "../../common/texts";
import { button, labelledField, option, setText } from "../../common/ui";

interface Input {
  field: TaskField;
  element: HTMLElement;
  /** Puts what was entered into the task; returns what is missing. */
  read(what: Record<string, unknown>, others: string[]): string | null;
}

/** A field's name for people: "altitude_msl_m" is "altitude msl". */
function title(field: TaskField): string {
  const suffix = field.unit ? new RegExp(`_${field.unit.replace(/[^a-z0-9]/gi, "")}$`) : /$^/;
  return field.name.replace(suffix, "").replace(/_/g, " ") || T.aircraft.position;
}

export class TaskFormView {
  readonly element = h("form", {
    class: "task-form",
    hidden: true,
    onsubmit: (event) => {
      event.preventDefault();
      this.send();
    },
  });
  private readonly kind: HTMLSelectElement;
  /** Whose task it is to be: empty: the chosen aircraft's; else a task of a team. */
  private readonly target = h("select", {});
  private readonly targets = labelledField(T.task.target, this.target);
  private readonly fields = h("div", { class: "fields" });
  private readonly help = h("p", { class: "hint" });
  private readonly estimate = h("p", { class: "hint", role: "status" });
  private readonly previews = h("ul", { class: "previews", role: "status" });
  private readonly problem = h("p", { class: "problem", role: "alert" });
  private inputs: Input[] = [];

  constructor(private readonly app: App) {
    this.kind = h("select", { onchange: () => this.build() }, ...app.run.task_kinds.map(({ kind }) => option(kind, T.task.names[kind] ?? kind)));
    this.element.append(
      this.targets,
      labelledField(T.task.kind, this.kind),
      this.help,
      this.fields,
      this.estimate,
      this.previews,
      this.problem,
      h(
        "div",
        { class: "actions" },
        h("button", { type: "submit", class: "primary" }, T.task.send),
        button(T.task.preview, () => this.preview()),
        button(T.cancel, () => this.toggle(false)),
      ),
    );
    if (app.run.task_kinds.length > 0) this.build();
    app.previews.onChange = () =>
      this.previews.replaceChildren(
        ...[...app.previews.shown.values()].map(({ state, text }) => h("li", { class: state === "refused" ? "problem" : "" }, text)),
      );
  }

  toggle(open = this.element.hidden): void {
    this.element.hidden = !open;
    if (open) {
      this.showTargets();
      this.kind.focus();
    } else {
      this.app.tools.stop();
      this.chosen(null);
      this.app.previews.clear();
    }
  }

  /** A team's tasks may be given where there is one: a new one, or one in the place of another. */
  private showTargets(): void {
    const { world } = this.app,
      tasks = [...world.teamTasks.values()],
      stations = [...new Set(tasks.map(({ entity_id }) => entity_id))];
    const open = tasks.filter(({ state }) => state !== "done" && state !== "withdrawn").sort((a, b) => a.number - b.number);
    this.targets.hidden = stations.length === 0;
    this.target.replaceChildren(
      option("", T.task.ofAircraft),
      ...stations.map((id) => option(`${id} 0`, T.task.ofTeam(world.name(id)))),
      ...open.map(({ entity_id, number, what }) => option(`${entity_id} ${number}`, T.task.inPlaceOf(number, T.task.names[what] ?? what))),
    );
  }

  /** Shows on the map what was chosen, and how far it is from the aircraft as the crow flies. */
  private chosen(points: [number, number][] | null, area = false): void {
    this.app.tools.show(points, area);
    const id = this.app.map.selected.values().next().value,
      { fleet } = this.app.world,
      row = id === undefined ? -1 : fleet.row(id);
    if (!points?.length || row < 0) return setText(this.estimate, "");
    let [north, east] = [fleet.get(row, "north_m"), fleet.get(row, "east_m")],
      length = 0;
    for (const [n, e] of points) {
      length += Math.hypot(n - north, e - east);
      [north, east] = [n, e];
    }
    const speed = Math.hypot(fleet.get(row, "velocity_north_mps"), fleet.get(row, "velocity_east_mps"));
    setText(this.estimate, T.task.estimate(this.app.units.distance(length), speed > 1 ? clock(length / speed) : T.none));
  }

  private get form(): TaskForm | undefined {
    return this.app.run.task_kinds.find(({ kind }) => kind === this.kind.value);
  }

  private build(): void {
    this.app.tools.stop();
    this.chosen(null);
    this.app.previews.clear();
    setText(this.problem, "");
    setText(this.help, this.form?.help ?? "");
    this.inputs = (this.form?.fields ?? []).map((field) => this.input(field));
    this.fields.replaceChildren(...this.inputs.map(({ element }) => element));
  }

  private input(field: TaskField): Input {
    switch (field.type) {
      case "place":
        return this.place(field);
      case "places":
        return this.places(field);
      case "flag": {
        const box = h("input", { type: "checkbox", checked: field.default === true });
        return {
          field,
          element: h("label", { class: "check" }, box, `${title(field)}: ${field.help}`),
          read: (what) => {
            what[field.name] = box.checked;
            return null;
          },
        };
      }
      case "word": {
        const select = h("select", {}, ...(field.words ?? []).map((word) => option(word, word, word === field.default)));
        return {
          field,
          element: labelledField(title(field), select, "", field.help),
          read: (what) => {
            what[field.name] = select.value;
            return null;
          },
        };
      }
      case "aircraft":
      case "aircraft_list":
        return this.aircraft(field);
      case "text": {
        const input = h("input", { type: "text", value: String(field.default ?? "") });
        return {
          field,
          element: labelledField(title(field), input, "", field.help),
          read: (what) => {
            what[field.name] = input.value;
            return null;
          },
        };
      }
      default: {
        const input = h("input", {
          type: "number",
          step: field.type === "integer" ? "1" : "any",
          value: field.default == null ? "" : String(field.default),
          placeholder: T.task.emptyIsDefault,
        });
        return {
          field,
          element: labelledField(title(field), input, field.unit ?? "", field.help),
          read: (what) => {
            if (input.value !== "") what[field.name] = Number(input.value);
            return null;
          },
        };
      }
    }
  }

  private aircraft(field: TaskField): Input {
    const many = field.type === "aircraft_list";
    const select = h("select", { multiple: many, size: many ? 4 : undefined }, ...this.app.run.aircraft.map(({ name }) => option(name, name)));
    return {
      field,
      element: labelledField(title(field), select, "", field.help),
      read: (_, others) => {
        const names = [...select.selectedOptions].map(({ value }) => value);
        if (names.length === 0) return title(field);
        others.push(...names);
        return null;
      },
    };
  }

  private place(field: TaskField): Input {
    const prefix = field.name ? `${field.name}_` : "";
    const number = (text: string) => h("input", { type: "number", step: "any", "aria-label": text, placeholder: text });
    const north = number("north"),
      east = number("east");
    const pick = button(T.task.pick, () =>
      this.app.tools.pickPlace(T.task.picking, (at) => {
        north.value = at.north_m.toFixed(1);
        east.value = at.east_m.toFixed(1);
        this.chosen([[at.north_m, at.east_m]]);
      }),
    );
    return {
      field,
      element: h(
        "fieldset",
        { class: "place" },
        h("legend", {}, title(field), h("span", { class: "unit" }, " m")),
        north,
        east,
        pick,
        h("span", { class: "help" }, field.help),
      ),
      read: (what) => {
        if (north.value === "" || east.value === "") return title(field);
        what[`${prefix}north_m`] = Number(north.value);
        what[`${prefix}east_m`] = Number(east.value);
        return null;
      },
    };
  }

  private places(field: TaskField): Input {
    let points: [number, number][] = [];
    const area = field.shape ? field.shape === "area" : /area|corner/.test(`${field.name} ${field.help}`);
    const count = h("span", { class: "count" }, T.task.points(0));
    const take = (next: [number, number][]) => {
      points = next;
      setText(count, T.task.points(points.length));
      this.chosen(points, area);
    };
    return {
      field,
      element: h(
        "fieldset",
        { class: "place" },
        h("legend", {}, title(field)),
        count,
        button(T.task.pick, () => this.app.tools.drawPlaces(area, T.task.drawing, take)),
        button(T.task.fromDrawing, () => {
          const ring = this.app.tools.chosenDrawing();
          if (ring) take(ring);
          else setText(this.problem, T.mission.noChosen);
        }),
        h("span", { class: "help" }, field.help),
      ),
      read: (what) => {
        if (points.length < (area ? 3 : 2)) return title(field);
        what[field.name] = points;
        return null;
      },
    };
  }

  /** The task as it was entered; null where something is missing, which is said. */
  private read(): { what: { kind: string; [name: string]: unknown }; others: string[] } | null {
    const form = this.form;
    if (!form) return null;
    const what: { kind: string; [name: string]: unknown } = { kind: form.kind },
      others: string[] = [];
    for (const input of this.inputs) {
      const missing = input.read(what, others);
      if (!missing) continue;
      setText(this.problem, T.task.missing(missing));
      return null;
    }
    setText(this.problem, "");
    return { what, others };
  }

  private get names(): string[] {
    return [...this.app.map.selected].map((id) => this.app.world.name(id));
  }

  private preview(): void {
    const task = this.read();
    if (task) this.app.previews.ask(this.names, task.what as never, task.others);
  }

  private send(): void {
    const task = this.read();
    if (!task) return;
    const [station, number] = this.target.value.split(" ").map(Number);
    if (number !== undefined) {
      const action = number > 0 ? "change" : "add";
      this.app.command(
        { kind: "change_team_task", action, number, what: task.what, others: task.others, station: this.app.world.name(station) },
        number > 0 ? T.commands.changeTask(number) : T.commands.addTask,
      );
    } else for (const name of this.names) this.app.giveTask(name, task.what as never, task.others);
    this.toggle(false);
  }
}
