// SPDX-License-Identifier: Apache-2.0
/** When alerts stood, aircraft by aircraft, along the time of the player. */
import type { Alerts } from "./alerts";
import type { RunData } from "./data";
import { clock, h } from "../common/dom";

export interface AlertStrip {
  element: HTMLElement;
  showTime(time: number): void;
}

const kClasses: Record<string, string> = { NEAR: "warning", MID: "corrective" };
const kRowsShown = 12;

/** One row for each alerted aircraft; null where there was no alert. A click shows that time. */
export function alertStrip(run: RunData, alerts: Alerts, end: number, onPick: (time: number) => void): AlertStrip | null {
  const names = new Map(run.entities.map((entity) => [entity.entity_id, entity.name]));
  const aircraft = alerts.aircraft().filter((id) => alerts.levels(id).some(({ level }) => level > 0));
  if (aircraft.length === 0 || end <= 0) return null;
  const percent = (time: number) => `${((100 * time) / end).toFixed(3)}%`;
  const cursors: HTMLElement[] = [];
  const rows = aircraft.slice(0, kRowsShown).map((id) => {
    const levels = alerts.levels(id);
    const marks = levels.flatMap(({ time, level, region }, i) => {
      if (level === 0) return [];
      const until = levels[i + 1]?.time ?? run.duration_s;
      return [
        h("span", {
          class: `alert-mark ${kClasses[region ?? ""] ?? "preventive"}`,
          style: `left:${percent(time)};width:${percent(until - time)}`,
          title: `${names.get(id) ?? id}: alert ${level}, ${clock(time)} to ${clock(until)}`,
        }),
      ];
    });
    const cursor = h("span", { class: "alert-cursor" });
    cursors.push(cursor);
    const bar = h(
      "div",
      {
        class: "alert-bar",
        onclick: (event) => {
          const box = bar.getBoundingClientRect();
          onPick((((event as MouseEvent).clientX - box.left) / Math.max(box.width, 1)) * end);
        },
      },
      ...marks,
      cursor,
    );
    return h("div", { class: "alert-row" }, h("span", { class: "alert-name" }, names.get(id) ?? `${id}`), bar);
  });
  const more = aircraft.length - rows.length;
  return {
    element: h(
      "div",
      { class: "alert-strip", role: "img", "aria-label": `When alerts about other aircraft stood, for ${aircraft.length} aircraft` },
      h("span", { class: "hint" }, "Alerts:"),
      ...rows,
      more > 0 ? h("span", { class: "hint" }, `and ${more} more aircraft`) : null,
    ),
    showTime: (time) =>
      cursors.forEach((cursor) => {
        cursor.style.left = percent(time);
      }),
  };
}
