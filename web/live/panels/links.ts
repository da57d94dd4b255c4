// SPDX-License-Identifier: Apache-2.0
/** How well the radios hear each other: a graph, a matrix, the weakest links. */
import { h, number } from "../../common/dom";
import { theme } from "../../common/theme";
import type { App } from "../app";
import { T } from "../../common/texts";
import { setText } from "../../common/ui";
import type { Link } from "../../common/world";
import type { Panel } from "./panel";

const kMost = 16; // entities of the picture
const kGood = 0.95,
  kFair = 0.7;
const kSize = 340; // [px]

const quality = (share: number | null) => (share === null ? "silent" : share >= kGood ? "good" : share >= kFair ? "fair" : "poor");

export class LinksPanel implements Panel {
  readonly element = h("div", { class: "panel" });
  private readonly canvas = h("canvas", { class: "graph", width: kSize, height: kSize, role: "img" });
  private readonly matrix = h("table", { class: "matrix" });
  private readonly worst = h("table", { class: "table" });
  private readonly none = h("p", { class: "hint" }, T.links.none);
  private readonly many = h("p", { class: "hint" });
  private readonly content: HTMLElement;
  private shown = "";

  constructor(private readonly app: App) {
    this.content = h(
      "div",
      { class: "panel-content" },
      h(
        "section",
        {},
        h("h3", {}, T.links.graph),
        this.canvas,
        h(
          "ul",
          { class: "link-legend" },
          ...Object.entries(T.links.legend).map(([name, text]) => h("li", {}, h("span", { class: `line ${name}`, "aria-hidden": "true" }), text)),
        ),
        this.many,
      ),
      h("section", {}, h("h3", {}, T.links.matrix), h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": T.links.matrix }, this.matrix)),
      h("section", {}, h("h3", {}, T.links.worst), this.worst),
    );
    this.element.append(this.none, this.content);
  }

  /** The entities that are shown: those with the most messages. */
  private entities(links: Link[]): number[] {
    const traffic = new Map<number, number>();
    for (const { from, to, last } of links) for (const id of [from, to]) traffic.set(id, (traffic.get(id) ?? 0) + last.arrived + last.lost);
    const all = [...traffic].sort((a, b) => b[1] - a[1]).map(([id]) => id);
    this.many.hidden = all.length <= kMost;
    setText(this.many, T.links.many(kMost));
    return all.slice(0, kMost).sort((a, b) => a - b);
  }

  update(): void {
    const { world } = this.app;
    const key = `${world.version.links} ${theme().dark}`;
    if (key === this.shown) return;
    this.shown = key;
    const links = [...world.links.values()];
    this.none.hidden = links.length > 0;
    this.content.hidden = links.length === 0;
    if (links.length === 0) return;
    const ids = this.entities(links);
    this.drawGraph(ids);
    this.showMatrix(ids);
    this.showWorst(links);
  }

  private drawGraph(ids: number[]): void {
    const { world } = this.app,
      ratio = Math.min(2, devicePixelRatio || 1),
      c = this.canvas.getContext("2d")!,
      colours = theme();
    if (this.canvas.width !== kSize * ratio) this.canvas.width = this.canvas.height = kSize * ratio;
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, kSize, kSize);
    const at = new Map(
      ids.map((id, k) => {
        const a = (2 * Math.PI * k) / ids.length - Math.PI / 2;
        return [id, [kSize / 2 + 0.33 * kSize * Math.cos(a), kSize / 2 + 0.38 * kSize * Math.sin(a), a] as const];
      }),
    );
    const pairs = [];
    for (const link of world.links.values()) {
      const from = at.get(link.from),
        to = at.get(link.to);
      if (from && to) pairs.push({ link, from, to });
    }
    pairs.sort((a, b) => (b.link.quality ?? 2) - (a.link.quality ?? 2)); // the worst on top
    for (const { link, from, to } of pairs) {
      const kind = quality(link.quality);
      // Each direction on its own side, width and dashes say the quality without colour.
      const dx = to[0] - from[0],
        dy = to[1] - from[1],
        l = Math.hypot(dx, dy),
        off = 3;
      c.beginPath();
      c.moveTo(from[0] + (off * -dy) / l, from[1] + (off * dx) / l);
      c.lineTo(to[0] + (off * -dy) / l, to[1] + (off * dx) / l);
      const [colour, width, dashes] = {
        good: [colours.mission, 2.6, []],
        fair: [colours.corrective, 2, [8, 4]],
        poor: [colours.warning, 1.6, [2, 4]],
        silent: [colours.muted, 1, []],
      }[kind] as [string, number, number[]];
      c.strokeStyle = colour;
      c.lineWidth = width;
      c.setLineDash(dashes);
      c.stroke();
    }
    c.setLineDash([]);
    c.font = "12px system-ui, sans-serif";
    for (const [id, [x, y, a]] of at) {
      c.beginPath();
      if (world.entities.get(id)?.kind === "station") c.rect(x - 7, y - 7, 14, 14);
      else c.arc(x, y, 7, 0, 7);
      c.fillStyle = colours.paper;
      c.strokeStyle = colours.ink;
      c.lineWidth = 2;
      c.fill();
      c.stroke();
      c.fillStyle = colours.ink;
      const name = world.name(id),
        side = Math.cos(a);
      c.textAlign = side > 0.3 ? "left" : side < -0.3 ? "right" : "center";
      c.fillText(name, x + (side > 0.3 ? 11 : side < -0.3 ? -11 : 0), y + (Math.abs(side) <= 0.3 ? (Math.sin(a) > 0 ? 22 : -13) : 4), 110);
    }
    this.canvas.setAttribute("aria-label", T.links.graph);
  }

  private cellText({ from, to, last, quality: share }: Link): string {
    const { world, units } = this.app;
    return T.links.cell(
      world.name(from),
      world.name(to),
      units.percent(share),
      last.rssi_dbm == null ? T.none : `${number(last.rssi_dbm)} dBm`,
      units.seconds(last.delay_s),
    );
  }

  private showMatrix(ids: number[]): void {
    const { world } = this.app;
    this.matrix.replaceChildren(
      h("thead", {}, h("tr", {}, h("td", {}), ...ids.map((id) => h("th", { scope: "col" }, h("span", {}, world.name(id)))))),
      h(
        "tbody",
        {},
        ...ids.map((from) =>
          h(
            "tr",
            {},
            h("th", { scope: "row" }, world.name(from)),
            ...ids.map((to) => {
              const link = world.links.get(`${from} ${to}`);
              if (!link) return h("td", { class: from === to ? "self" : "" }, from === to ? "" : "·");
              return h(
                "td",
                { class: quality(link.quality), title: this.cellText(link) },
                link.quality === null ? "–" : String(Math.round(100 * link.quality)),
              );
            }),
          ),
        ),
      ),
    );
  }

  private showWorst(links: Link[]): void {
    const { world, units } = this.app;
    const worst = links
      .filter((link) => link.quality !== null)
      .sort((a, b) => a.quality! - b.quality!)
      .slice(0, 6);
    this.worst.replaceChildren(
      h("thead", {}, h("tr", {}, ...Object.values(T.links.columns).map((text, k) => h("th", { scope: "col", class: k > 0 ? "number" : undefined }, text)))),
      h(
        "tbody",
        {},
        ...worst.map((link) =>
          h(
            "tr",
            {},
            h("th", { scope: "row" }, `${world.name(link.from)} → ${world.name(link.to)}`),
            h("td", { class: "number" }, units.percent(link.quality)),
            h("td", { class: "number" }, link.last.rssi_dbm == null ? T.none : `${number(link.last.rssi_dbm)} dBm`),
            h("td", { class: "number" }, units.seconds(link.last.delay_s)),
          ),
        ),
      ),
    );
  }
}
