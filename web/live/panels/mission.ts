// SPDX-License-Identifier: Apache-2.0
/** Missions, proposals that wait for approval, no-fly zones, drawings. */
import { clock, h } from "../../common/dom";
import type { ZoneRecord } from "../../common/records";
import type { App } from "../app";
import { kMaxFile, leftOutOfPlan, readFeatures, saveGeoJson, saveKml, savePlan } from "../geo/files";
import type { DrawMode } from "../map/drawing";
import { T } from "../../common/texts";
import { button, iconButton, labelledField, setText } from "../../common/ui";
import type { Panel } from "./panel";

const kModes: DrawMode[] = ["select", "point", "linestring", "polygon", "circle"];

const kPlanHeight = 120; // of drawings that become waypoints, over home [m]

export class MissionPanel implements Panel {
  readonly element = h("div", { class: "panel" });
  private readonly missions = h("ul", { class: "list" });
  private readonly proposals = h("ul", { class: "list" });
  private readonly teamTasks = h("ul", { class: "list" });
  private readonly zones = h("ul", { class: "list" });
  private readonly drawings = h("ul", { class: "list" });
  private readonly said = h("p", { class: "hint", role: "status" });
  private readonly zoneForm: HTMLFormElement;
  private readonly zoneName = h("input", { type: "text", required: true, maxlength: 60 });
  private readonly limits = ["floor_msl_m", "ceiling_msl_m", "from_s", "until_s"].map((name) => ({
    name,
    input: h("input", { type: "number", step: "any", placeholder: T.mission.noLimit }),
  }));
  private readonly modes: HTMLButtonElement[];
  private readonly undo: HTMLButtonElement;
  private readonly redo: HTMLButtonElement;
  private readonly removes: HTMLButtonElement;
  private shown = "";
  private shownDrawings = -1;
  private changes = 0;

  constructor(private readonly app: App) {
    const { drawing } = app;
    drawing.onChange = () => {
      ++this.changes;
    };
    this.modes = kModes.map((mode) => iconButton(mode, T.mission.draw[mode], () => drawing.set(drawing.mode === mode ? null : mode)));
    this.undo = iconButton("undo", T.mission.undo, () => drawing.undo());
    this.redo = iconButton("redo", T.mission.redo, () => drawing.redo());
    this.removes = iconButton("trash", T.mission.remove, () => drawing.remove());
    const file = h("input", {
      type: "file",
      accept: ".geojson,.json,.kml,.plan",
      hidden: true,
      "aria-label": T.mission.load,
      onchange: () => void this.load(file),
    });
    const titles = [T.mission.floor, T.mission.ceiling, T.mission.from, T.mission.until],
      unitsOf = ["m", "m", "s", "s"];
    this.zoneForm = h(
      "form",
      {
        class: "task-form",
        hidden: true,
        onsubmit: (event) => {
          event.preventDefault();
          this.newZone();
        },
      },
      labelledField(T.mission.zoneName, this.zoneName),
      h("div", { class: "two" }, ...this.limits.map(({ input }, k) => labelledField(titles[k], input, unitsOf[k]))),
      h(
        "div",
        { class: "actions" },
        h("button", { type: "submit", class: "primary" }, T.mission.zoneOn),
        button(T.cancel, () => {
          this.zoneForm.hidden = true;
        }),
      ),
    );
    this.element.append(
      h("section", {}, h("h3", {}, T.mission.proposals), this.proposals),
      h("section", {}, h("h3", {}, T.mission.teamTasks), this.teamTasks),
      h(
        "section",
        {},
        h("h3", {}, T.mission.missions),
        this.missions,
        h(
          "div",
          { class: "actions" },
          button(T.mission.pauseAll, () => this.mission("pause", "")),
          button(T.mission.resumeAll, () => this.mission("resume", "")),
        ),
      ),
      h(
        "section",
        {},
        h("h3", {}, T.mission.drawings),
        h("div", { class: "actions tools", role: "toolbar", "aria-label": T.mission.drawings }, ...this.modes, this.undo, this.redo, this.removes),
        this.drawings,
        h(
          "div",
          { class: "actions" },
          button(T.mission.newZone, () => this.openZone()),
          button(T.mission.load, () => file.click()),
          file,
          button(T.mission.saveGeojson, () => saveGeoJson(drawing.all(), app.frame, `${app.run.name}-drawings`)),
          button(T.mission.saveKml, () => saveKml(drawing.all(), app.frame, `${app.run.name}-drawings`)),
          button(T.mission.savePlan, () => this.savePlan()),
        ),
        this.zoneForm,
        this.said,
        h("p", { class: "hint" }, T.mission.drawHint),
      ),
      h("section", {}, h("h3", {}, T.mission.zones), this.zones),
    );
  }

  private mission(action: "pause" | "resume" | "start" | "end", mission: string): void {
    this.app.command({ kind: "mission", action, mission }, T.commands.mission(action, mission));
  }

  private async load(file: HTMLInputElement): Promise<void> {
    const chosen = file.files?.[0];
    file.value = "";
    if (!chosen) return;
    if (chosen.size > kMaxFile) return setText(this.said, T.mission.tooLarge(chosen.name));
    try {
      const { features, notes } = await readFeatures(chosen);
      const taken = this.app.drawing.add(features);
      setText(this.said, [T.mission.loaded(taken, features.length - taken), ...notes].join(" "));
    } catch (problem) {
      setText(this.said, problem instanceof Error ? problem.message : T.mission.unreadable(chosen.name));
    }
  }

  private savePlan(): void {
    const { drawing, frame, run } = this.app,
      all = drawing.all(),
      left = leftOutOfPlan(all);
    savePlan(all, frame, kPlanHeight, `${run.name}-drawings`);
    setText(this.said, left > 0 ? T.mission.notInPlan(left) : "");
  }

  private openZone(): void {
    const drawn = this.app.drawing.drawn();
    if (drawn?.geometry.kind !== "area") return setText(this.said, T.mission.noChosen);
    if (drawn.purpose === "inclusion") return setText(this.said, T.mission.staysIn);
    setText(this.said, "");
    this.zoneForm.hidden = false;
    this.zoneName.value = drawn.name || `zone-${this.app.world.zones.size + 1}`;
    this.zoneName.focus();
    this.zoneName.select();
  }

  private newZone(): void {
    const drawn = this.app.drawing.drawn();
    if (drawn?.geometry.kind !== "area") return setText(this.said, T.mission.noChosen);
    const name = this.zoneName.value.trim().replace(/\s+/g, "-");
    const area = drawn.circle
      ? { kind: "disc", centre_north_m: drawn.circle.north_m, centre_east_m: drawn.circle.east_m, radius_m: drawn.circle.radius_m }
      : { kind: "ring", points: drawn.geometry.rings[0] };
    const limits = Object.fromEntries(this.limits.filter(({ input }) => input.value !== "").map(({ name: key, input }) => [key, Number(input.value)]));
    this.app.command({ kind: "zone", in_force: true, name, area, ...limits }, T.commands.zoneOn(name));
    this.app.drawing.remove();
    this.app.drawing.set(null);
    this.zoneForm.hidden = true;
  }

  update(): void {
    const { world, drawing, mayCommand } = this.app,
      { version } = world;
    this.modes.forEach((each, k) => each.setAttribute("aria-pressed", String(drawing.mode === kModes[k])));
    this.undo.disabled = !drawing.canUndo;
    this.redo.disabled = !drawing.canRedo;
    this.removes.disabled = drawing.chosen === null;
    if (this.changes !== this.shownDrawings) {
      this.shownDrawings = this.changes;
      this.showDrawings();
    }
    const key = `${version.missions} ${version.zones} ${version.allocations} ${mayCommand} ${this.app.settings.units}`;
    if (key === this.shown) return;
    this.shown = key;
    this.showMissions();
    this.showProposals();
    this.showTeamTasks();
    this.showZones();
  }

  private showDrawings(): void {
    const { drawing, units } = this.app;
    this.drawings.replaceChildren(
      ...drawing.all().map((drawn) => {
        const g = drawn.geometry;
        const what = drawn.circle
          ? `${T.mission.draw.circle}, ${units.distance(drawn.circle.radius_m)}`
          : g.kind === "point"
            ? T.mission.draw.point
            : g.kind === "line"
              ? `${T.mission.draw.linestring}, ${T.task.points(g.points.length)}`
              : `${T.mission.draw.polygon}, ${T.task.points(g.rings[0].length)}`;
        const purpose = drawn.purpose ? `${T.mission.purposes[drawn.purpose]}: ${what}` : what;
        return h(
          "li",
          {},
          h(
            "button",
            { type: "button", class: "quiet", "aria-pressed": String(drawing.chosen === drawn.id), onclick: () => drawing.choose(drawn.id) },
            drawn.name ? `${drawn.name}: ${purpose}` : purpose,
          ),
        );
      }),
    );
  }

  private showMissions(): void {
    const { world, mayCommand } = this.app;
    this.missions.replaceChildren(
      ...[...world.missions.values()].map(({ mission: name, goal: { kind } }) => {
        const state = world.missions.get(name)?.state ?? "waiting",
          runs = state !== "over" && state !== "waiting" && state !== "paused";
        const act = (text: string, action: "pause" | "resume" | "start" | "end") => button(text, () => this.mission(action, name), { disabled: !mayCommand });
        return h(
          "li",
          { class: "card" },
          h("div", {}, h("strong", {}, name), h("span", { class: "unit" }, ` ${kind}`)),
          h("span", { class: `state ${state}` }, T.missionState[state] ?? state),
          h(
            "div",
            { class: "actions" },
            ...(state === "waiting" || state === "over"
              ? [act(T.mission.start, "start")]
              : [runs ? act(T.mission.pause, "pause") : act(T.mission.resume, "resume"), act(T.mission.end, "end")]),
          ),
        );
      }),
    );
  }

  private showProposals(): void {
    const { world, mayCommand, app } = { world: this.app.world, mayCommand: this.app.mayCommand, app: this.app };
    const newest = [...world.allocations.values()].sort((a, b) => b.time_s - a.time_s).filter((each, k) => each.state === "waits" || k < 3);
    if (newest.length === 0) return this.proposals.replaceChildren(h("li", { class: "hint" }, T.mission.noProposals));
    this.proposals.replaceChildren(
      ...newest.map((each) => {
        const decide = (text: string, action: "approve" | "reject") =>
          h(
            "button",
            {
              type: "button",
              class: action === "approve" ? "primary" : undefined,
              disabled: !mayCommand,
              onclick: () => app.command({ kind: "allocation", action, number: each.number, station: "" }, T.commands.allocation(action, each.number)),
            },
            text,
          );
        return h(
          "li",
          { class: "card" },
          h("div", {}, h("strong", {}, T.mission.proposal(each.number, world.name(each.proposer_id)))),
          h("span", { class: `state ${each.state}` }, T.mission.states[each.state] ?? each.state),
          each.state === "waits" || each.shares.length > 0
            ? h(
                "div",
                { class: "wide-cell" },
                ...each.shares.map(({ entity_id, task }) => h("div", {}, T.mission.share(world.name(entity_id), task))),
                h("div", { class: "hint" }, T.mission.utility((each.value ?? 0).toFixed(2), (each.bound ?? 0).toFixed(2))),
              )
            : null,
          each.state === "waits" ? h("div", { class: "actions" }, decide(T.mission.approve, "approve"), decide(T.mission.reject, "reject")) : null,
        );
      }),
    );
  }

  /** What is left first, in the order of numbers; then what is over. */
  private showTeamTasks(): void {
    const { world, mayCommand } = this.app,
      over = (state: string) => Number(state === "done" || state === "withdrawn");
    const all = [...world.teamTasks.values()].sort((a, b) => over(a.state) - over(b.state) || a.number - b.number);
    if (all.length === 0) return this.teamTasks.replaceChildren(h("li", { class: "hint" }, T.mission.noTeamTasks));
    this.teamTasks.replaceChildren(
      ...all.map((task) => {
        const { number, entity_id } = task,
          station = world.name(entity_id);
        const withdraw = button(
          T.mission.withdraw,
          () => this.app.command({ kind: "change_team_task", action: "withdraw", number, station }, T.commands.withdraw(number)),
          { disabled: !mayCommand },
        );
        const flown = task.executor_id == null ? "" : T.mission.flownBy(world.name(task.executor_id));
        return h(
          "li",
          { class: "card" },
          h(
            "div",
            {},
            h("strong", {}, T.mission.teamTask(number, T.task.names[task.what] ?? task.what)),
            h(
              "div",
              { class: "hint" },
              [flown, task.after.length > 0 ? T.mission.after(task.after.join(", ")) : "", task.several ? T.mission.group : ""].filter(Boolean).join(", "),
            ),
          ),
          h("span", { class: `state ${task.state}` }, T.mission.taskStates[task.state] ?? task.state),
          over(task.state) ? null : h("div", { class: "actions" }, withdraw),
        );
      }),
    );
  }

  private zoneLimits({ floor_msl_m, ceiling_msl_m, from_s, until_s }: ZoneRecord): string {
    const { units } = this.app;
    const heights = T.mission.limits(
      floor_msl_m == null ? T.mission.ground : units.height(floor_msl_m),
      ceiling_msl_m == null ? T.mission.sky : units.height(ceiling_msl_m),
    );
    return heights + (from_s == null && until_s == null ? "" : `, ${from_s == null ? "" : clock(from_s)} – ${until_s == null ? "" : clock(until_s)}`);
  }

  private showZones(): void {
    const { world, mayCommand } = this.app;
    if (world.zones.size === 0) return this.zones.replaceChildren(h("li", { class: "hint" }, T.mission.noZones));
    this.zones.replaceChildren(
      ...[...world.zones.values()].map((zone) =>
        h(
          "li",
          { class: "card" },
          h("div", {}, h("strong", {}, zone.name), h("div", { class: "hint" }, this.zoneLimits(zone))),
          button(T.mission.zoneOff, () => this.app.command({ kind: "zone", in_force: false, name: zone.name }, T.commands.zoneOff(zone.name)), {
            disabled: !mayCommand,
          }),
        ),
      ),
    );
  }
}
