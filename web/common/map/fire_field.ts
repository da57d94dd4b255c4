// SPDX-License-Identifier: Apache-2.0
/** The fire: the truth, what is believed of it, forecasts, and what has been measured. */
import type { Theme } from "../theme";
import { T } from "../texts";
import { put, spot, type Boxes, type FieldView } from "./field_view";
import type { Projector } from "./projector";
import { trace, traceBand, type Points } from "./shapes";

const kCrossingShown = 300,
  kReadingShown = 60; // they fade over this time [s]
const kAges = 12; // of marks that fade: each is drawn at once

let hatch: { dark: boolean; pattern: CanvasPattern | null } | null = null;

/** The true fire is hatched: it differs from what is believed without colour too. */
function hatching(c: CanvasRenderingContext2D, theme: Theme): CanvasPattern | string {
  if (hatch?.dark !== theme.dark) {
    const tile = document.createElement("canvas");
    tile.width = tile.height = 10;
    const t = tile.getContext("2d")!;
    t.strokeStyle = theme.truth;
    t.globalAlpha = 0.45;
    t.lineWidth = 1;
    t.beginPath();
    for (const k of [-10, 0, 10]) {
      t.moveTo(k, 10);
      t.lineTo(k + 10, 0);
    }
    t.stroke();
    hatch = { dark: theme.dark, pattern: c.createPattern(tile, "repeat") };
  }
  return hatch.pattern ?? theme.truthFill;
}

export function drawForecasts(c: CanvasRenderingContext2D, v: FieldView, boxes: Boxes): void {
  for (const all of v.world.forecasts.values())
    for (const forecast of [...all.values()].sort((a, b) => b.boundary_time_s - a.boundary_time_s)) {
      const ahead = forecast.boundary_time_s - v.time;
      if (ahead <= 0) continue;
      const horizon = Math.round((forecast.boundary_time_s - forecast.made_s) / 60);
      if (v.layers.horizon > 0 && Math.abs(horizon - v.layers.horizon) > 0.5) continue;
      for (const ring of forecast.boundary_rings) {
        const band = v.shaper.band(ring);
        if (v.layers.forecastBands) {
          c.beginPath();
          traceBand(c, v.camera, band);
          c.fillStyle = v.theme.belief;
          c.globalAlpha = 0.1;
          c.fill("nonzero");
        }
        c.beginPath();
        trace(c, v.camera, band.middle, true);
        c.globalAlpha = Math.max(0.45, 0.95 - ahead / 6000);
        c.strokeStyle = v.theme.belief;
        c.lineWidth = 1.4;
        c.setLineDash([1.5, 4]);
        c.stroke();
        c.setLineDash([]);
        c.globalAlpha = 1;
        if (!v.layers.names) continue;
        // Where the ring is farthest to the right: labels of several horizons stand beside each other.
        let bx = -Infinity,
          by = 0;
        for (let i = 0; i < band.middle.length; i += 3)
          if (v.camera.project(band.middle[i], band.middle[i + 1], band.middle[i + 2]) && v.camera.x > bx && v.camera.x < v.camera.width - 90) {
            bx = v.camera.x;
            by = v.camera.y;
          }
        if (bx > 0) put(c, v, boxes, T.map.inMinutes(Math.round(ahead / 60)), bx, by, v.theme.belief);
      }
    }
}

/** Each how many of a ring's points have room on the screen: 1, 2, 4... */
function roomFor(camera: Projector, ring: Points): number {
  if (ring.length < 6 || !camera.project(ring[0], ring[1], ring[2])) return 1;
  const { x, y } = camera;
  let length = 0,
    far = 0;
  for (let i = 3; i < Math.min(ring.length, 36); i += 3)
    if (camera.project(ring[i], ring[i + 1], ring[i + 2])) {
      far = Math.max(far, Math.hypot(camera.x - x, camera.y - y));
      length = i / 3;
    }
  const each = length > 0 ? far / length : 20;
  return each > 9 ? 1 : each > 4.5 ? 2 : 4;
}

export function drawFire(c: CanvasRenderingContext2D, v: FieldView): void {
  const { layers, theme, camera, shaper } = v;
  for (const perimeter of v.world.perimeters.values()) {
    if (layers.truth && perimeter.truth.length > 0) {
      c.beginPath();
      for (const ring of perimeter.truth) trace(c, camera, shaper.line(ring), true);
      c.fillStyle = theme.truthFill;
      c.fill("evenodd");
      c.fillStyle = hatching(c, theme);
      c.fill("evenodd");
      c.strokeStyle = theme.truth;
      c.lineWidth = 1.6;
      c.stroke();
    }
    const bands = perimeter.belief_rings.filter((ring) => ring.length > 2).map((ring) => shaper.band(ring));
    if (layers.band) {
      c.beginPath();
      for (const band of bands) traceBand(c, camera, band);
      c.fillStyle = theme.bandFill;
      c.fill("nonzero");
    }
    if (!layers.belief) continue;
    c.beginPath();
    for (const band of bands) trace(c, camera, band.middle, true);
    c.lineJoin = "round";
    c.strokeStyle = theme.paper;
    c.globalAlpha = 0.6;
    c.lineWidth = 5;
    c.stroke();
    c.globalAlpha = 1;
    c.strokeStyle = theme.belief;
    c.lineWidth = 2.4;
    c.setLineDash([9, 4]);
    c.stroke();
    c.setLineDash([]);
    if (!layers.sigmas) continue;
    c.beginPath();
    for (const { inner1, outer1, middle } of bands) {
      const step = 3 * roomFor(camera, middle);
      for (let i = 0; i < middle.length; i += step) {
        if (!camera.project(inner1[i], inner1[i + 1], inner1[i + 2])) continue;
        c.moveTo(camera.x, camera.y);
        if (!camera.project(outer1[i], outer1[i + 1], outer1[i + 2])) continue;
        c.lineTo(camera.x, camera.y);
      }
    }
    c.lineWidth = 1.2;
    c.stroke();
    c.fillStyle = theme.belief;
    c.beginPath();
    for (const { middle } of bands)
      for (let i = 0, step = 3 * roomFor(camera, middle); i < middle.length; i += step)
        if (camera.project(middle[i], middle[i + 1], middle[i + 2])) c.rect(camera.x - 1.5, camera.y - 1.5, 3, 3);
    c.fill();
  }
}

/** Marks that fade: each added to a path, and the path painted, with how fresh its marks are. */
function drawFading(
  c: CanvasRenderingContext2D,
  v: FieldView,
  marks: readonly { time_s: number; north_m: number | null; east_m: number | null }[],
  shown: number,
  add: (x: number, y: number) => void,
  paint: (freshness: number) => void,
): void {
  const ages: number[][] = Array.from({ length: kAges }, () => []);
  for (const { time_s, north_m, east_m } of marks) {
    const age = (v.time - time_s) / shown;
    if (age >= 0 && age < 1 && spot(v, north_m, east_m)) ages[Math.floor(age * kAges)].push(v.camera.x, v.camera.y);
  }
  for (let k = kAges - 1; k >= 0; --k) {
    if (ages[k].length === 0) continue;
    c.beginPath();
    for (let i = 0; i < ages[k].length; i += 2) add(ages[k][i], ages[k][i + 1]);
    paint(1 - (k + 0.5) / kAges);
  }
  c.globalAlpha = 1;
}

export function drawReadings(c: CanvasRenderingContext2D, v: FieldView): void {
  const { theme, world } = v;
  c.lineWidth = 1.3;
  if (v.layers.readings)
    for (const side of [false, true]) {
      // Inside: filled; outside: hollow.
      c.fillStyle = side ? theme.truth : theme.paper;
      c.strokeStyle = side ? theme.truth : theme.ink;
      drawFading(
        c,
        v,
        world.readings.filter(({ inside }) => inside === side),
        kReadingShown,
        (x, y) => {
          c.moveTo(x + 2.4, y);
          c.arc(x, y, 2.4, 0, 7);
        },
        (freshness) => {
          c.globalAlpha = 0.9 * freshness;
          c.fill();
          c.stroke();
        },
      );
    }
  if (!v.layers.crossings) return;
  c.strokeStyle = theme.crossing;
  drawFading(
    c,
    v,
    world.crossings,
    kCrossingShown,
    (x, y) => {
      const r = 3;
      c.moveTo(x - r, y - r);
      c.lineTo(x + r, y + r);
      c.moveTo(x - r, y + r);
      c.lineTo(x + r, y - r);
    },
    (freshness) => {
      c.globalAlpha = 0.1 + 0.7 * freshness;
      c.stroke();
    },
  );
}
