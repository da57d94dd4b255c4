// SPDX-License-Identifier: Apache-2.0
/**
 * What changes slowly: the fire as it is believed, its bands and forecasts, zones' names, missions'
 * goals, objects, tasks, other traffic. Drawn on a canvas of its own, again only when the camera
 * moves or something of it changes.
 */
import { T } from "../texts";
import { kFont, put, spot, writeLabel, type Boxes, type FieldView } from "./field_view";
import { drawFire, drawForecasts, drawReadings } from "./fire_field";
import { drawFootprints, drawRecommended, drawTasks, drawTracks, drawTraffic } from "./flight_field";
import { drawPaths } from "./paths";
import { trace, type Points } from "./shapes";

const kDetectionShown = 300; // fades over this time [s]

/** Lines of the local frame. */
function drawGrid(c: CanvasRenderingContext2D, v: FieldView, grid: NonNullable<FieldView["grid"]>): void {
  const power = Math.pow(10, Math.floor(Math.log10(110 / v.camera.scale)));
  const step = ([1, 2, 5].find((k) => k * power * v.camera.scale >= 80) ?? 10) * power;
  const n = Math.min(60, Math.ceil(grid.half_m / step)),
    north = Math.round(grid.north_m / step) * step,
    east = Math.round(grid.east_m / step) * step,
    reach = n * step;
  c.strokeStyle = v.theme.muted;
  c.globalAlpha = 0.3;
  c.lineWidth = 1;
  c.beginPath();
  for (let k = -n; k <= n; ++k) {
    trace(
      c,
      v.camera,
      v.shaper.points([
        [north - reach, east + k * step],
        [north + reach, east + k * step],
      ]),
      false,
    );
    trace(
      c,
      v.camera,
      v.shaper.points([
        [north + k * step, east - reach],
        [north + k * step, east + reach],
      ]),
      false,
    );
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
    const dt = v.time - motion.time_s,
      known = world.objectBeliefs.has(id) || world.found.has(id);
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
    if (v.layers.names)
      put(c, v, boxes, T.map.fireIn(arrival.place, arrival.middle_s == null ? null : Math.round((arrival.middle_s - v.time) / 60)), x, y - 8, theme.ink);
  }
}

function drawZoneNames(c: CanvasRenderingContext2D, v: FieldView, boxes: Boxes): void {
  for (const zone of v.world.zonesAt(v.time)) {
    let north = 0,
      east = 0;
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
    const width = c.measureText(zone.name).width,
      { x, y } = v.camera;
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
