/**
 * What changes slowly: the fire as it is believed, its bands and forecasts, zones' names, missions'
 * goals, objects, tasks, other traffic. Drawn on a canvas of its own, again only when the camera
 * moves or something of it changes.
 */
import { alertColour, type Theme } from "../../report/theme";
import type { Layers } from "../settings";
import { T } from "../texts";
import type { World } from "../world";
import { drawPaths } from "./paths";
import type { Projector } from "./projector";
import { trace, traceBand, type Points, type Shaper } from "./shapes";

const kCrossingShown = 300, kReadingShown = 60, kDetectionShown = 300; // they fade over this time [s]
const kTrackShown = 5; // of other traffic, after it was believed last [s]
const kRecommendedBefore = 5; // of a path, behind the aircraft [s]
const kMany = 40; // from so many aircraft on, only chosen ones show where their tasks lead
const kFont = "12px system-ui, 'Segoe UI', Roboto, sans-serif";

export interface FieldView {
  world: World;
  camera: Projector;
  shaper: Shaper;
  theme: Theme;
  layers: Layers;
  time: number;
  selected: ReadonlySet<number>;
  grid: { north_m: number; east_m: number; half_m: number } | null; // where there is no relief to see
}

/** Boxes of labels that stand already: others keep off. */
export class Boxes {
  private readonly taken: number[] = [];
  clear(): void {
    this.taken.length = 0;
  }
  free(x: number, y: number, width: number, height: number): boolean {
    const t = this.taken;
    for (let i = 0; i < t.length; i += 4)
      if (x < t[i + 2] && t[i] < x + width && y < t[i + 3] && t[i + 1] < y + height) return false;
    return true;
  }
  add(x: number, y: number, width: number, height: number): void {
    this.taken.push(x, y, x + width, y + height);
  }
}

export function writeLabel(c: CanvasRenderingContext2D, text: string, x: number, y: number, colour: string, paper: string): void {
  c.save();
  c.font = kFont;
  c.lineWidth = 3.5;
  c.lineJoin = "round";
  c.strokeStyle = paper;
  c.strokeText(text, x, y);
  c.fillStyle = colour;
  c.fillText(text, x, y);
  c.restore();
}

const place = new Float64Array(3);

function spot(v: FieldView, north: number | null, east: number | null): boolean {
  if (north == null || east == null) return false;
  v.shaper.one(north, east, place);
  return v.camera.project(place[0], place[1], place[2]);
}

/** Writes a text where it is free, if it is. */
function put(c: CanvasRenderingContext2D, v: FieldView, boxes: Boxes, text: string, x: number, y: number, colour: string): void {
  c.font = kFont;
  const width = c.measureText(text).width;
  for (const [dx, dy] of [[11, 4], [-11 - width, 4], [-width / 2, -12], [-width / 2, 20]]) {
    if (!boxes.free(x + dx - 3, y + dy - 12, width + 6, 16)) continue;
    boxes.add(x + dx - 3, y + dy - 12, width + 6, 16);
    writeLabel(c, text, x + dx, y + dy, colour, v.theme.paper);
    return;
  }
}

/** Lines of the local frame. */
function drawGrid(c: CanvasRenderingContext2D, v: FieldView, grid: NonNullable<FieldView["grid"]>): void {
  const power = Math.pow(10, Math.floor(Math.log10(110 / v.camera.scale)));
  const step = ([1, 2, 5].find((k) => k * power * v.camera.scale >= 80) ?? 10) * power;
  const n = Math.min(60, Math.ceil(grid.half_m / step)), north = Math.round(grid.north_m / step) * step, east = Math.round(grid.east_m / step) * step, reach = n * step;
  c.strokeStyle = v.theme.muted;
  c.globalAlpha = 0.3;
  c.lineWidth = 1;
  c.beginPath();
  for (let k = -n; k <= n; ++k) {
    trace(c, v.camera, v.shaper.points([[north - reach, east + k * step], [north + reach, east + k * step]]), false);
    trace(c, v.camera, v.shaper.points([[north + k * step, east - reach], [north + k * step, east + reach]]), false);
  }
  c.stroke();
  c.globalAlpha = 1;
}

function drawMissions(c: CanvasRenderingContext2D, v: FieldView, boxes: Boxes): void {
  c.strokeStyle = v.theme.mission;
  for (const { mission, state, goal } of v.world.missions.values()) {
    if (state === "over") continue;
    const lines: [Points, boolean][] = [];
    if (goal.area) lines.push([v.shaper.line(goal.area), true]);
    for (const hole of goal.holes ?? []) lines.push([v.shaper.line(hole), true]);
    if (goal.line) lines.push([v.shaper.line(goal.line), goal.closed ?? false]);
    if (lines.length === 0) continue;
    c.setLineDash([2, 4]);
    c.lineWidth = 2;
    c.beginPath();
    for (const [points, closed] of lines) trace(c, v.camera, points, closed);
    c.stroke();
    c.setLineDash([]);
    const first = lines[0][0];
    if (v.layers.names && v.camera.project(first[0], first[1], first[2]))
      put(c, v, boxes, state === "paused" ? `${mission} (${T.missionState.paused})` : mission, v.camera.x, v.camera.y, v.theme.mission);
  }
}

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

function drawForecasts(c: CanvasRenderingContext2D, v: FieldView, boxes: Boxes): void {
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
        let bx = -Infinity, by = 0;
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
  let length = 0, far = 0;
  for (let i = 3; i < Math.min(ring.length, 36); i += 3)
    if (camera.project(ring[i], ring[i + 1], ring[i + 2])) {
      far = Math.max(far, Math.hypot(camera.x - x, camera.y - y));
      length = i / 3;
    }
  const each = length > 0 ? far / length : 20;
  return each > 9 ? 1 : each > 4.5 ? 2 : 4;
}

function drawFire(c: CanvasRenderingContext2D, v: FieldView): void {
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

function drawReadings(c: CanvasRenderingContext2D, v: FieldView): void {
  const { theme, world } = v;
  if (v.layers.readings) {
    c.lineWidth = 1.3;
    for (let i = world.readings.length - 1; i >= 0; --i) {
      const reading = world.readings[i], age = v.time - reading.time_s;
      if (age < 0 || age > kReadingShown || !spot(v, reading.north_m, reading.east_m)) continue;
      c.globalAlpha = 0.9 * (1 - age / kReadingShown);
      c.beginPath();
      c.arc(v.camera.x, v.camera.y, 2.4, 0, 7);
      // Inside: filled; outside: hollow.
      c.fillStyle = reading.inside ? theme.truth : theme.paper;
      c.strokeStyle = reading.inside ? theme.truth : theme.ink;
      c.fill();
      c.stroke();
    }
  }
  if (v.layers.crossings) {
    c.strokeStyle = theme.crossing;
    c.lineWidth = 1.3;
    for (const crossing of world.crossings) {
      const age = v.time - crossing.time_s;
      if (age < 0 || age > kCrossingShown || !spot(v, crossing.north_m, crossing.east_m)) continue;
      c.globalAlpha = 0.1 + 0.7 * (1 - age / kCrossingShown);
      const { x, y } = v.camera, r = 3;
      c.beginPath();
      c.moveTo(x - r, y - r);
      c.lineTo(x + r, y + r);
      c.moveTo(x - r, y + r);
      c.lineTo(x + r, y - r);
      c.stroke();
    }
  }
  c.globalAlpha = 1;
}

function drawObjects(c: CanvasRenderingContext2D, v: FieldView, boxes: Boxes): void {
  const { world, theme } = v;
  c.strokeStyle = theme.found;
  c.lineWidth = 1.5;
  for (const detection of world.detections) {
    const age = v.time - detection.time_s;
    if (age < 0 || age > kDetectionShown || !spot(v, detection.north_m, detection.east_m)) continue;
    c.globalAlpha = 0.2 + 0.7 * (1 - age / kDetectionShown);
    c.strokeRect(v.camera.x - 2, v.camera.y - 2, 4, 4);
  }
  c.globalAlpha = 1;
  for (const [id, motion] of world.objectMotions) {
    const dt = v.time - motion.time_s, known = world.objectBeliefs.has(id) || world.found.has(id);
    if (!spot(v, (motion.north_m ?? 0) + dt * (motion.velocity_north_mps ?? 0), (motion.east_m ?? 0) + dt * (motion.velocity_east_mps ?? 0))) continue;
    const { x, y } = v.camera;
    c.fillStyle = known ? theme.found : theme.paper;
    c.fillRect(x - 4.5, y - 4.5, 9, 9);
    c.strokeRect(x - 4.5, y - 4.5, 9, 9);
    if (v.layers.names) put(c, v, boxes, world.objects.get(id)?.name ?? String(id), x, y, theme.found);
  }
  for (const belief of world.objectBeliefs.values()) {
    if (belief.north_m == null || belief.east_m == null) continue;
    c.beginPath();
    trace(c, v.camera, v.shaper.circle(belief.north_m, belief.east_m, 1.96 * (belief.position_sd_m ?? 0)), true);
    c.setLineDash([3, 3]);
    c.stroke();
    c.setLineDash([]);
  }
  for (const arrival of world.arrivals.values()) {
    if (!spot(v, arrival.north_m, arrival.east_m)) continue;
    const { x, y } = v.camera;
    c.strokeStyle = theme.ink;
    c.beginPath();
    c.moveTo(x, y + 6);
    c.lineTo(x, y - 14);
    c.lineTo(x + 10, y - 10);
    c.lineTo(x, y - 6);
    c.stroke();
    if (v.layers.names) put(c, v, boxes, T.map.fireIn(arrival.place, arrival.middle_s == null ? null : Math.round((arrival.middle_s - v.time) / 60)), x, y - 8, theme.ink);
  }
}

function drawFootprints(c: CanvasRenderingContext2D, v: FieldView): void {
  c.strokeStyle = v.theme.found;
  c.lineWidth = 1.2;
  for (const f of v.world.footprints.values()) {
    const age = v.time - f.time_s;
    if (age > 10 || age < -1) continue;
    c.globalAlpha = 0.9 - 0.07 * Math.max(0, age);
    c.beginPath();
    const corners = [[f.corner_1_north_m, f.corner_1_east_m], [f.corner_2_north_m, f.corner_2_east_m],
      [f.corner_3_north_m, f.corner_3_east_m], [f.corner_4_north_m, f.corner_4_east_m]];
    corners.forEach(([north, east], k) => {
      if (!spot(v, north, east)) return;
      if (k === 0) c.moveTo(v.camera.x, v.camera.y);
      else c.lineTo(v.camera.x, v.camera.y);
    });
    c.closePath();
    c.stroke();
  }
  c.globalAlpha = 1;
}

const plane = new Float64Array(2);

/** The points of a task, in the order in which they are flown; an area's corners. */
function pointsOf(what: Record<string, unknown>): [number, number][] {
  const list = (what.points ?? what.line ?? what.area) as [number, number][] | undefined;
  if (Array.isArray(list) && list.length > 0) return what.area || what.closed ? [...list, list[0]] : list;
  const { north_m, east_m } = what as { north_m?: number; east_m?: number };
  // An edge is followed from where it is found, home is where the aircraft knows it.
  if (what.kind === "follow_edge" || what.at_home === true || north_m == null || east_m == null) return [];
  return [[north_m, east_m]];
}

/** All of the way that aircraft have come. */
function drawTracks(c: CanvasRenderingContext2D, v: FieldView): void {
  const { fleet } = v.world, many = fleet.count > kMany;
  c.lineWidth = many ? 0.8 : 1.3;
  c.lineJoin = "round";
  c.globalAlpha = many ? 0.4 : 0.65;
  for (const [id, { points, count }] of fleet.tracks?.all ?? []) {
    c.beginPath();
    trace(c, v.camera, points.subarray(0, 3 * count), false);
    c.strokeStyle = fleet.count <= 8 ? v.theme.series[fleet.row(id) % 8] : v.theme.belief;
    c.stroke();
  }
  c.globalAlpha = 1;
}

/** Paths that are recommended to pilots. */
function drawRecommended(c: CanvasRenderingContext2D, v: FieldView): void {
  c.strokeStyle = v.theme.recommended;
  c.lineWidth = 2;
  c.setLineDash([8, 4]);
  for (const { path } of v.world.recommendations.values()) {
    const ahead = path.filter((point) => (point.time_s ?? 0) >= v.time - kRecommendedBefore);
    c.beginPath();
    ahead.forEach(({ north_m, east_m }, i) => {
      if (!spot(v, north_m, east_m)) return;
      if (i === 0) c.moveTo(v.camera.x, v.camera.y);
      else c.lineTo(v.camera.x, v.camera.y);
    });
    c.stroke();
  }
  c.setLineDash([]);
}

function drawTasks(c: CanvasRenderingContext2D, v: FieldView): void {
  const { fleet, frame, tasks } = v.world;
  for (const { entity_id, what } of tasks.values()) {
    const chosen = v.selected.has(entity_id), row = fleet.row(entity_id);
    if (row < 0 || (fleet.count > kMany && !chosen)) continue;
    const places = pointsOf(what as unknown as Record<string, unknown>);
    if (places.length === 0) continue;
    const height = fleet.get(row, "altitude_msl_m");
    const points = new Float64Array(3 * places.length);
    places.forEach(([north, east], i) => {
      frame.toPlane(north, east, plane, 0);
      points.set([plane[0], plane[1], height], 3 * i);
    });
    c.beginPath();
    trace(c, v.camera, points, false);
    c.strokeStyle = fleet.count <= 8 ? v.theme.series[row % 8] : v.theme.belief;
    c.lineWidth = chosen ? 2.6 : 1.5;
    c.globalAlpha = chosen ? 1 : 0.75;
    c.setLineDash([6, 4]);
    c.stroke();
    c.setLineDash([]);
    if (v.camera.project(points[0], points[1], points[2])) {
      c.beginPath();
      c.arc(v.camera.x, v.camera.y, 4, 0, 7);
      c.fillStyle = v.theme.paper;
      c.fill();
      c.stroke();
    }
  }
  c.globalAlpha = 1;
}

function drawTraffic(c: CanvasRenderingContext2D, v: FieldView, boxes: Boxes): void {
  const { world, theme, camera } = v;
  const levels = new Map<string, { level: number; region: string }>();
  for (const alert of world.alerts.values()) levels.set(`${alert.entity_id} ${alert.track}`, alert);
  for (const [key, track] of world.trafficTracks) {
    const dt = v.time - track.time_s;
    if (dt > kTrackShown + world.gap || track.north_m == null || track.east_m == null) continue;
    const north = track.north_m + dt * (track.velocity_north_mps ?? 0), east = track.east_m + dt * (track.velocity_east_mps ?? 0);
    const alert = levels.get(key), colour = alert ? alertColour(alert.region, theme) : theme.traffic;
    c.strokeStyle = colour;
    c.lineWidth = alert ? 2.4 : 1.2;
    c.beginPath();
    trace(c, camera, v.shaper.circle(north, east, 2 * (track.horizontal_sd_m ?? 0)), true);
    c.stroke();
    if (!spot(v, north, east)) continue;
    const { x, y } = camera;
    c.beginPath(); // where it is in a minute's sixth
    c.moveTo(x, y);
    if (spot(v, north + 10 * (track.velocity_north_mps ?? 0), east + 10 * (track.velocity_east_mps ?? 0))) c.lineTo(camera.x, camera.y);
    c.stroke();
    diamond(c, x, y, colour, alert ? colour : theme.paper);
    if (v.layers.names) put(c, v, boxes, T.map.trackOf(world.name(track.believer_id), alert ? T.alertRegion[alert.region] ?? "" : ""), x, y, colour);
  }
  if (!v.layers.truth) return;
  for (const [id, motion] of world.trafficMotions) {
    if (motion.phase !== "flies" && motion.phase !== "jumped") continue;
    const dt = v.time - motion.time_s;
    if (!spot(v, (motion.north_m ?? 0) + dt * (motion.velocity_north_mps ?? 0), (motion.east_m ?? 0) + dt * (motion.velocity_east_mps ?? 0))) continue;
    const { x, y } = camera;
    diamond(c, x, y, theme.traffic, theme.paper);
    if (v.layers.names && world.traffic.size <= kMany) put(c, v, boxes, world.traffic.get(id)?.name ?? String(id), x, y, theme.traffic);
  }
}

function diamond(c: CanvasRenderingContext2D, x: number, y: number, stroke: string, fill: string): void {
  c.beginPath();
  c.moveTo(x, y - 7);
  c.lineTo(x + 6, y);
  c.lineTo(x, y + 7);
  c.lineTo(x - 6, y);
  c.closePath();
  c.fillStyle = fill;
  c.strokeStyle = stroke;
  c.lineWidth = 1.8;
  c.fill();
  c.stroke();
}

function drawZoneNames(c: CanvasRenderingContext2D, v: FieldView, boxes: Boxes): void {
  for (const zone of v.world.zonesAt(v.time)) {
    let north = 0, east = 0;
    if (zone.area.kind === "disc") {
      north = zone.area.centre_north_m ?? 0;
      east = zone.area.centre_east_m ?? 0;
    } else {
      const { points } = zone.area;
      if (points.length === 0) continue;
      for (const [n, e] of points) {
        north += n / points.length;
        east += e / points.length;
      }
    }
    if (!spot(v, north, east)) continue;
    c.font = kFont;
    const width = c.measureText(zone.name).width, { x, y } = v.camera;
    boxes.add(x - width / 2 - 3, y - 9, width + 6, 16);
    writeLabel(c, zone.name, x - width / 2, y + 4, v.theme.zone, v.theme.paper);
  }
}

/** Draws all of it; the context's units are CSS pixels. */
export function drawField(c: CanvasRenderingContext2D, v: FieldView, boxes: Boxes): void {
  boxes.clear();
  c.clearRect(0, 0, v.camera.width, v.camera.height);
  if (v.grid) drawGrid(c, v, v.grid);
  if (v.layers.missions) drawMissions(c, v, boxes);
  if (v.layers.forecasts) drawForecasts(c, v, boxes);
  drawFire(c, v);
  drawReadings(c, v);
  if (v.layers.footprints) drawFootprints(c, v);
  if (v.layers.zones && v.layers.names) drawZoneNames(c, v, boxes);
  if (v.layers.objects) drawObjects(c, v, boxes);
  if (v.layers.tracks) drawTracks(c, v);
  if (v.layers.tasks) drawTasks(c, v);
  if (v.layers.paths) drawPaths(c, v);
  if (!v.layers.traffic) return;
  drawTraffic(c, v, boxes);
  drawRecommended(c, v);
}
