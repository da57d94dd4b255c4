// SPDX-License-Identifier: Apache-2.0
/** What aircraft do besides where they are: tasks, tracks, footprints, recommended paths; and other traffic. */
import { alertColour } from "../theme";
import { T } from "../texts";
import { kMany, put, spot, type Boxes, type FieldView } from "./field_view";
import { trace } from "./shapes";

const kTrackShown = 5; // of other traffic, after it was believed last [s]
const kRecommendedBefore = 5; // of a path, behind the aircraft [s]

export function drawFootprints(c: CanvasRenderingContext2D, v: FieldView): void {
  c.strokeStyle = v.theme.found;
  c.lineWidth = 1.2;
  for (const f of v.world.footprints.values()) {
    const age = v.time - f.time_s;
    if (age > 10 || age < -1) continue;
    c.globalAlpha = 0.9 - 0.07 * Math.max(0, age);
    c.beginPath();
    const corners = [
      [f.corner_1_north_m, f.corner_1_east_m],
      [f.corner_2_north_m, f.corner_2_east_m],
      [f.corner_3_north_m, f.corner_3_east_m],
      [f.corner_4_north_m, f.corner_4_east_m],
    ];
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
  const named = what as { begin_north_m?: number; begin_east_m?: number };
  const { north_m = named.begin_north_m, east_m = named.begin_east_m } = what as { north_m?: number; east_m?: number };
  // An edge is followed from where it is found, home is where the aircraft knows it.
  if (what.kind === "follow_edge" || what.at_home === true || north_m == null || east_m == null) return [];
  return [[north_m, east_m]];
}

/** All of the way that aircraft have come. */
export function drawTracks(c: CanvasRenderingContext2D, v: FieldView): void {
  const { fleet } = v.world,
    many = fleet.count > kMany;
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
export function drawRecommended(c: CanvasRenderingContext2D, v: FieldView): void {
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

export function drawTasks(c: CanvasRenderingContext2D, v: FieldView): void {
  const { fleet, frame, tasks } = v.world;
  for (const { entity_id, what } of tasks.values()) {
    const chosen = v.selected.has(entity_id),
      row = fleet.row(entity_id);
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

export function drawTraffic(c: CanvasRenderingContext2D, v: FieldView, boxes: Boxes): void {
  const { world, theme, camera } = v;
  const levels = new Map<string, { level: number; region: string }>();
  for (const alert of world.alerts.values()) levels.set(`${alert.entity_id} ${alert.track}`, alert);
  for (const [key, track] of world.trafficTracks) {
    const dt = v.time - track.time_s;
    if (dt > kTrackShown + world.gap || track.north_m == null || track.east_m == null) continue;
    const north = track.north_m + dt * (track.velocity_north_mps ?? 0),
      east = track.east_m + dt * (track.velocity_east_mps ?? 0);
    const alert = levels.get(key),
      colour = alert ? alertColour(alert.region, theme) : theme.traffic;
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
    if (v.layers.names) put(c, v, boxes, T.map.trackOf(world.name(track.believer_id), alert ? (T.alertRegion[alert.region] ?? "") : ""), x, y, colour);
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
