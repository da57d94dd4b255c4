// SPDX-License-Identifier: Apache-2.0
/** What the radios of a run did: who heard whom how well, how full the air was. */
import { floats, type RunData } from "./data";
import { h, number } from "../common/dom";
import type { Line } from "../common/chart";

/** Load of the air over time, mean of all radios and the fullest. */
export function loadLines(runs: RunData[]): Line[] {
  return runs.flatMap((run, r) => {
    if (!run.radio) return [];
    const x = floats(run.radio.time_s);
    const name = (text: string) => (runs.length === 1 ? text : `${run.label}: ${text}`);
    return [
      { name: name("mean of all radios"), x, y: Array.from(floats(run.radio.load_mean)), colour: (runs.length === 1 ? 0 : r) % 8 },
      { name: name("fullest"), x, y: Array.from(floats(run.radio.load_max)), colour: (runs.length === 1 ? 1 : r) % 8, dash: "dashed" as const },
    ];
  });
}

const kCauses = /^messages_lost_(.*)$/;

function lossTable(run: RunData): HTMLElement | null {
  const causes = Object.entries(run.summary)
    .flatMap(([name, count]) => {
      const cause = kCauses.exec(name)?.[1];
      return cause ? [{ cause: cause.replace(/_/g, " "), count }] : [];
    })
    .sort((a, b) => b.count - a.count);
  if (causes.length === 0) return null;
  return h(
    "table",
    { class: "events" },
    h("caption", {}, "Messages lost, and why"),
    h("thead", {}, h("tr", {}, ...["Cause", "Messages"].map((text) => h("th", { scope: "col" }, text)))),
    h("tbody", {}, ...causes.map(({ cause, count }) => h("tr", {}, h("td", {}, cause), h("td", {}, number(count, 6))))),
  );
}

function radioTable(run: RunData, names: Map<number, string>): HTMLElement {
  const columns = ["Radio", "Sends", "Hears others", "Frames", "Most waiting", "No room", "Given up", "Too old", "Received"];
  const share = (value: number) => `${number(100 * value, 2)} %`;
  return h(
    "div",
    { class: "scroll" },
    h(
      "table",
      { class: "events" },
      h("caption", {}, "Radios: shares of the time, packets"),
      h("thead", {}, h("tr", {}, ...columns.map((text) => h("th", { scope: "col" }, text)))),
      h(
        "tbody",
        {},
        ...run.radio!.radios.map((radio) =>
          h(
            "tr",
            {},
            ...[
              names.get(radio.entity) ?? String(radio.entity),
              share(radio.sending),
              share(radio.busy),
              number(radio.frames, 6),
              number(radio.waiting, 6),
              number(radio.queue_full, 6),
              number(radio.retry_limit, 6),
              number(radio.expired, 6),
              number(radio.received, 6),
            ].map((text) => h("td", {}, text)),
          ),
        ),
      ),
    ),
  );
}

/** Rows send, columns receive; the darker the more of what was sent has arrived. */
function linkMatrix(run: RunData, names: Map<number, string>): HTMLElement {
  const links = run.radio!.links;
  const ids = (pick: (link: (typeof links)[number]) => number) => [...new Set(links.map(pick))].sort((a, b) => a - b);
  const from = ids((link) => link.from),
    to = ids((link) => link.to);
  const byPair = new Map(links.map((link) => [`${link.from} ${link.to}`, link]));
  const nameOf = (id: number) => names.get(id) ?? String(id);
  const cell = (row: number, column: number) => {
    const link = byPair.get(`${row} ${column}`);
    if (!link) return h("td", {}, "");
    const all = link.arrived + link.lost,
      share = link.arrived / all;
    const level = link.rssi_dbm == null ? "" : `, ${number(link.rssi_dbm, 3)} dBm, SINR ${number(link.sinr_db, 3)} dB`;
    const delay = link.delay_s == null ? "" : `, after ${number(1000 * link.delay_s, 3)} ms`;
    if (all === 0) return h("td", { class: "silent", title: `${nameOf(row)} to ${nameOf(column)}: heard, nothing said${level}` }, "–");
    return h(
      "td",
      { style: `--share: ${share.toFixed(3)}`, title: `${nameOf(row)} to ${nameOf(column)}: ${link.arrived} of ${all} messages${delay}${level}` },
      `${Math.round(100 * share)}`,
    );
  };
  return h(
    "div",
    { class: "scroll" },
    h(
      "table",
      { class: "link-matrix" },
      h("caption", {}, "Who heard whom: share of the messages that arrived [%]; rows send, columns receive"),
      h("thead", {}, h("tr", {}, h("th", {}, ""), ...to.map((id) => h("th", { scope: "col" }, nameOf(id))))),
      h("tbody", {}, ...from.map((row) => h("tr", {}, h("th", { scope: "row" }, nameOf(row)), ...to.map((column) => cell(row, column))))),
    ),
  );
}

/** Nothing where the radio has no medium. */
export function radioPanel(run: RunData): HTMLElement[] {
  if (!run.radio) return [];
  const names = new Map(run.entities.map((entity) => [entity.entity_id, entity.name]));
  return [lossTable(run), linkMatrix(run, names), radioTable(run, names)].filter((part): part is HTMLElement => part !== null);
}
