// SPDX-License-Identifier: Apache-2.0
/** The fire: what is believed of it and how sure that is, where it will be, when it comes. */
import { clock, h } from "../../common/dom";
import type { BoundaryPoint } from "../../common/records";
import type { App } from "../app";
import { fireFeatures } from "../geo/export_fire";
import { saveGeoJson, saveKml } from "../geo/files";
import { T } from "../../common/texts";
import { button, Facts, setText } from "../../common/ui";
import type { Panel } from "./panel";

/** Area and length of rings; holes count against the area. */
export function measureRings(rings: BoundaryPoint[][]): { area: number; length: number; sigma: number; sigmaMax: number; growth: number } {
  let area = 0,
    length = 0,
    weighted = 0,
    sigmaMax = 0,
    growth = 0;
  for (const ring of rings)
    ring.forEach((p, i) => {
      const q = ring[(i + 1) % ring.length];
      const [pn, pe, qn, qe] = [p.north_m ?? 0, p.east_m ?? 0, q.north_m ?? 0, q.east_m ?? 0];
      area += (pn * qe - qn * pe) / 2; // outer rings run clockwise on the map
      const edge = Math.hypot(qn - pn, qe - pe);
      length += edge;
      weighted += (edge * ((p.sigma_m ?? 0) + (q.sigma_m ?? 0))) / 2;
      sigmaMax = Math.max(sigmaMax, p.sigma_m ?? 0);
      growth = Math.max(growth, p.rate_mps ?? 0);
    });
  return { area: Math.abs(area), length, sigma: length > 0 ? weighted / length : 0, sigmaMax, growth };
}

export class FirePanel implements Panel {
  readonly element = h("div", { class: "panel" });
  private readonly headline = h("p", { class: "headline" });
  private readonly beliefs = h("div", { class: "beliefs" });
  private readonly facts = new Map<string, Facts>();
  private readonly forecasts = h("table", { class: "table" });
  private readonly made = h("h3", {}, T.fire.forecasts);
  private readonly arrivals = h("table", { class: "table" });
  private readonly empty = h("p", { class: "hint" }, T.fire.noBelief);
  private shown = "";

  constructor(private readonly app: App) {
    const all = () => fireFeatures(app.world);
    this.element.append(
      h("section", {}, h("h3", {}, T.fire.headline), this.headline),
      h("section", {}, this.empty, this.beliefs),
      h("section", {}, this.made, this.forecasts),
      h("section", {}, h("h3", {}, T.fire.arrivals), this.arrivals, h("p", { class: "hint" }, T.fire.arrivalHint)),
      h(
        "section",
        {},
        h("h3", {}, T.fire.export),
        h(
          "div",
          { class: "actions" },
          button(T.fire.exportGeojson, () => saveGeoJson(all(), app.frame, `${app.run.name}-fire`)),
          button(T.fire.exportKml, () => saveKml(all(), app.frame, `${app.run.name}-fire`)),
          // The server makes these.
          h("a", { class: "button", href: "api/fire.gpkg", download: "" }, T.fire.exportGpkg),
          h("a", { class: "button", href: "api/fire.shp.zip", download: "" }, T.fire.exportShp),
        ),
      ),
    );
  }

  update(): void {
    const { world, units } = this.app,
      { version } = world;
    setText(this.headline, world.clock.headline || T.none);
    const key = `${version.fire} ${version.forecast} ${version.arrival} ${Math.floor(world.time)} ${this.app.settings.units}`;
    if (key === this.shown) return;
    this.shown = key;
    this.empty.hidden = world.perimeters.size > 0;
    for (const perimeter of world.perimeters.values()) {
      let facts = this.facts.get(perimeter.mission);
      if (!facts) {
        facts = new Facts();
        this.facts.set(perimeter.mission, facts);
        this.beliefs.append(h("h3", {}, perimeter.mission), facts.element);
      }
      const m = measureRings(perimeter.belief_rings);
      facts.set(T.fire.area, units.area(m.area));
      facts.set(T.fire.length, units.distance(m.length));
      facts.set(T.fire.sigma, units.distance(m.sigma));
      facts.set(T.fire.sigmaMax, units.distance(m.sigmaMax));
      facts.set(T.fire.growth, units.speed(m.growth));
      facts.set(T.fire.age, clock(perimeter.belief_time_s));
      facts.set(T.fire.truth, perimeter.truth.length > 0 ? T.fire.shown : T.fire.hidden);
      facts.set(T.fire.sure, T.fire.within(units.distance(1.96 * m.sigma)));
    }
    this.showForecasts();
    this.showArrivals();
  }

  private showForecasts(): void {
    const { world, units } = this.app;
    const rows = [...world.forecasts.values()].flatMap((all) => [...all.values()].sort((a, b) => a.boundary_time_s - b.boundary_time_s));
    setText(this.made, rows.length > 0 ? T.fire.made(clock(rows[0].made_s)) : T.fire.forecasts);
    this.forecasts.replaceChildren(
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          ...[T.fire.horizon, T.fire.area, T.fire.length, T.fire.sigma].map((text, k) => h("th", { scope: "col", class: k > 0 ? "number" : undefined }, text)),
        ),
      ),
      h(
        "tbody",
        {},
        ...rows.map((forecast) => {
          const m = measureRings(forecast.boundary_rings);
          return h(
            "tr",
            {},
            h("th", { scope: "row" }, T.map.inMinutes(Math.round((forecast.boundary_time_s - world.time) / 60))),
            h("td", { class: "number" }, units.area(m.area)),
            h("td", { class: "number" }, units.distance(m.length)),
            h("td", { class: "number" }, units.distance(m.sigma)),
          );
        }),
      ),
    );
  }

  private showArrivals(): void {
    const { world } = this.app;
    const at = (time: number | null) => (time == null ? T.none : clock(time));
    this.arrivals.replaceChildren(
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          ...[T.fire.place, T.fire.early, T.fire.middle, T.fire.late].map((text, k) => h("th", { scope: "col", class: k > 0 ? "number" : undefined }, text)),
        ),
      ),
      h(
        "tbody",
        {},
        ...[...world.arrivals.values()].map((arrival) =>
          h(
            "tr",
            {},
            h(
              "th",
              { scope: "row" },
              button(arrival.place, () => this.app.map.goTo(arrival.north_m ?? 0, arrival.east_m ?? 0), { class: "quiet" }),
            ),
            ...[arrival.early_s, arrival.middle_s, arrival.late_s].map((time) => h("td", { class: "number" }, at(time))),
          ),
        ),
      ),
    );
  }
}
