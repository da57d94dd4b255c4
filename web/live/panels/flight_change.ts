// SPDX-License-Identifier: Apache-2.0
/** How high and how fast the chosen aircraft fly what they were given, from now on. */
import { h } from "../../common/dom";
import type { App } from "../app";
import { T } from "../../common/texts";
import { button, labelledField, setText } from "../../common/ui";

export class FlightChangeForm {
  readonly element = h("form", {
    class: "task-form",
    hidden: true,
    onsubmit: (event) => {
      event.preventDefault();
      this.send();
    },
  });
  private readonly height = h("input", { type: "number", min: "1", step: "any", placeholder: T.task.emptyIsDefault });
  private readonly speed = h("input", { type: "number", min: "0.1", step: "any", placeholder: T.task.emptyIsDefault });
  private readonly problem = h("p", { class: "problem", role: "alert" });

  constructor(private readonly app: App) {
    this.element.append(
      labelledField(T.aircraft.overGround, this.height, "m"),
      labelledField(T.aircraft.airspeed, this.speed, "m/s"),
      this.problem,
      h(
        "div",
        { class: "actions" },
        h("button", { type: "submit", class: "primary" }, T.task.send),
        button(T.cancel, () => this.toggle(false)),
      ),
    );
  }

  toggle(open = this.element.hidden): void {
    this.element.hidden = !open;
    if (open) this.height.focus();
  }

  private send(): void {
    const { height, speed } = this;
    if (height.value === "" && speed.value === "") return setText(this.problem, T.task.heightOrSpeed);
    setText(this.problem, "");
    for (const id of this.app.map.selected) {
      const aircraft = this.app.world.name(id);
      this.app.command(
        {
          kind: "change_flight",
          aircraft,
          ...(height.value === "" ? {} : { altitude_agl_m: Number(height.value) }),
          ...(speed.value === "" ? {} : { airspeed_mps: Number(speed.value) }),
        },
        T.commands.flight(aircraft),
      );
    }
    this.toggle(false);
  }
}
