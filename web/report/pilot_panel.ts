// SPDX-License-Identifier: Apache-2.0
/** The panel with the display of one aircraft's pilot, at the time of the player. */
import type { World } from "../common/world";
import type { Alerts } from "./alerts";
import { paint } from "./canvas";
import { believers, Cockpit } from "./cockpit";
import { clock, h, number } from "../common/dom";
import { drawPilotDisplay, fittingRange, kRanges } from "./pilot_display";

export interface PilotPanel {
  element: HTMLElement;
  showTime(time: number): void;
}

const kHeight = 460;

/** What is said of the alerts that stand, in words. */
function words({ alerts, aircraft }: Cockpit, time: number): string[] {
  const lines = alerts
    .standing(aircraft, time)
    .slice(0, 3)
    .map((alert) => {
      const age = time - alert.time_s;
      const hour = ((((Math.round((alert.bearing_deg ?? 0) / 30) + 11) % 12) + 12) % 12) + 1;
      return (
        `Alert ${alert.level} about track ${alert.track} for ${Math.round(age)} s: it was at ${hour} o'clock, ` +
        `${number((alert.distance_m ?? 0) / 1000, 2)} km, ${Math.round(Math.abs(alert.height_m ?? 0))} m ` +
        `${(alert.height_m ?? 0) < 0 ? "below" : "above"}.`
      );
    });
  const bands = alerts.bands(aircraft, time);
  if (bands && bands[2] !== null) lines.push(`Advised track ${String(Math.round(bands[2]) % 360).padStart(3, "0")}.`);
  if (bands && bands[5] !== null) lines.push(`Well clear again in ${Math.round(bands[5])} s by a track that is green.`);
  const shown = alerts.recommendation(aircraft, time);
  if (shown) lines.push(`Recommended path (${shown.state}): ${shown.reason}.`);
  return lines;
}

/** Null where no aircraft has followed anybody or was shown anything; the world is of the end of the run at first. */
export function pilotPanel(world: World, alerts: Alerts): PilotPanel | null {
  const all = [...new Set([...alerts.aircraft(), ...believers(world)])]
    .sort((a, b) => a - b)
    .filter((id) => world.fleet.row(id) >= 0)
    .map((id) => new Cockpit(world, alerts, id));
  if (all.length === 0) return null;
  // Who was alerted most is looked at first.
  const worst = ({ aircraft }: Cockpit) => Math.max(0, ...alerts.levels(aircraft).map(({ level }) => level));
  let cockpit = all.reduce((best, each) => (worst(each) > worst(best) ? each : best));
  let time = world.time,
    range = 0;
  const canvas = h("canvas", { class: "pilot", role: "img", tabindex: 0 });
  const said = h("p", { class: "pilot-words" });
  const draw = () => {
    const width = canvas.clientWidth,
      height = canvas.clientHeight;
    if (width === 0 || height === 0) return;
    const own = cockpit.own(time);
    const shown = range > 0 || !own ? range || 4000 : fittingRange(cockpit, own, time);
    const lines = own ? words(cockpit, time) : [];
    said.textContent = lines.length > 0 ? lines.join(" ") : "No alert stands.";
    canvas.setAttribute("aria-label", `Display of ${cockpit.name} at ${clock(time)}. ${said.textContent}`);
    paint(canvas, width, height, (context) => drawPilotDisplay(context, cockpit, time, shown, width, height));
  };
  const choice = h(
    "select",
    {
      "aria-label": "Aircraft",
      onchange: () => {
        cockpit = all[Number(choice.value)];
        draw();
      },
    },
    ...all.map((each, i) => h("option", { value: i, selected: each === cockpit }, each.name)),
  );
  const ranges = h(
    "select",
    {
      "aria-label": "Range",
      onchange: () => {
        range = Number(ranges.value);
        draw();
      },
    },
    h("option", { value: 0, selected: true }, "automatic"),
    ...kRanges.map((each) => h("option", { value: each }, each < 1000 ? `${each} m` : `${each / 1000} km`)),
  );
  new ResizeObserver(draw).observe(canvas);
  canvas.style.height = `${kHeight}px`;
  return {
    element: h(
      "div",
      { class: "pilot-panel" },
      h("div", { class: "controls" }, h("label", {}, "Aircraft ", choice), h("label", {}, "Range ", ranges)),
      canvas,
      said,
      h(
        "p",
        { class: "hint" },
        "Nose up. Diamonds: other traffic, filled when it is within 11 km and 366 m; yellow: " +
          "preventive, amber circle: corrective, red square: warning alert, each with its height above the own [m]; rings: " +
          "two deviations of where it is believed. Arcs and stripes: tracks, speeds, altitudes and vertical speeds that lead " +
          "into conflict; dashed green: recovery; green marks: advised. Magenta: recommended path. It shows the time of the map.",
      ),
    ),
    showTime: (now) => {
      time = now;
      draw();
    },
  };
}
