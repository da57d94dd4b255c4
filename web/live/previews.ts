// SPDX-License-Identifier: Apache-2.0
/** What aircraft would do with a task that is not given yet: asked of the server, which flies it ahead. */
import { clock } from "../common/dom";
import type { App } from "./app";
import type { PathPoint, TaskPreview, What } from "../common/protocol";
import { T } from "../common/texts";

export interface Preview {
  aircraft: string;
  state: "asked" | "known" | "refused";
  text: string; // for people
  path: PathPoint[];
}

export class Previews {
  /** Of the form that is open: one for each aircraft that was asked about. */
  readonly shown = new Map<number, Preview>();
  onChange: () => void = () => undefined;

  constructor(private readonly app: App) {
    app.world.onPreview = (preview) => this.take(preview);
  }

  ask(aircraft: string[], what: Partial<What> & { kind: string }, others: string[]): void {
    this.shown.clear();
    for (const name of aircraft) {
      const sent = this.app.connection.send(
        { preview: { kind: "task", aircraft: name, what, ...(others.length > 0 ? { others } : {}) } },
        T.commands.preview(name, T.task.names[what.kind] ?? what.kind),
        (settled) => {
          const asked = this.shown.get(settled.number);
          if (!asked || asked.state === "known" || (settled.state !== "refused" && settled.state !== "lost")) return;
          asked.state = "refused";
          asked.text = `${name}: ${settled.reason || T.events.states.lost}`;
          this.changed();
        },
      );
      this.shown.set(sent.number, { aircraft: name, state: "asked", text: T.task.previewAsked(name), path: [] });
    }
    this.changed();
  }

  clear(): void {
    if (this.shown.size === 0) return;
    this.shown.clear();
    this.changed();
  }

  private take(preview: TaskPreview): void {
    const asked = this.shown.get(preview.number);
    if (!asked) return;
    const { units } = this.app;
    asked.path = preview.points;
    asked.state = preview.problem ? "refused" : "known";
    asked.text = preview.problem
      ? `${asked.aircraft}: ${preview.problem}`
      : T.task.previewed(asked.aircraft, preview.done, clock(preview.duration_s ?? 0), units.distance(preview.length_m)) +
        // Simple models have no battery.
        (preview.charge ? T.task.previewedBattery(units.percent(preview.charge), units.percent(preview.charge_left)) : "");
    this.changed();
  }

  private changed(): void {
    this.app.map.redraw();
    this.onChange();
  }
}
