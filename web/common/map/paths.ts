// SPDX-License-Identifier: Apache-2.0
/** Paths ahead: how aircraft expect to fly, and how one would fly a task that is not given yet. */
import type { PathPoint } from "../protocol";
import type { FieldView } from "./field_view";
import { trace, type Points } from "./shapes";

const kMany = 40; // from so many aircraft on, only chosen ones show their path
const made = new WeakMap<object, Points>();

/** Its points in the plane of the map, at the heights at which they are flown. */
function inPlane(v: FieldView, path: readonly PathPoint[]): Points {
  let points = made.get(path);
  if (points) return points;
  points = new Float64Array(3 * path.length);
  path.forEach(({ north_m, east_m, altitude_msl_m }, i) => {
    v.world.frame.toPlane(north_m, east_m, points!, 3 * i);
    points![3 * i + 2] = altitude_msl_m;
  });
  made.set(path, points);
  return points;
}

/** What of a path lies ahead, from where the aircraft should be now on. */
export function ahead(path: readonly PathPoint[], points: Points, passed: number): Points {
  let next = path.findIndex(({ ahead_s }) => ahead_s > passed);
  if (next < 0) return new Float64Array(0);
  if (next === 0) return points;
  const from = path[next - 1],
    to = path[next],
    share = (passed - from.ahead_s) / Math.max(1e-6, to.ahead_s - from.ahead_s);
  const rest = points.slice(3 * --next);
  for (let k = 0; k < 3; ++k) rest[k] += share * (points[3 * next + 3 + k] - rest[k]);
  return rest;
}

export function drawPaths(c: CanvasRenderingContext2D, v: FieldView): void {
  const { fleet, paths } = v.world;
  for (const { entity_id, time_s, points } of paths.values()) {
    const chosen = v.selected.has(entity_id),
      row = fleet.row(entity_id);
    if (row < 0 || (fleet.count > kMany && !chosen)) continue;
    c.beginPath();
    trace(c, v.camera, ahead(points, inPlane(v, points), v.time - time_s), false);
    c.strokeStyle = fleet.count <= 8 ? v.theme.series[row % 8] : v.theme.belief;
    c.lineWidth = chosen ? 2.4 : 1.2;
    c.globalAlpha = chosen ? 1 : 0.6;
    c.stroke();
  }
  c.globalAlpha = 1;
}

/** Of a task that is thought of: wider, with a mark where it ends. */
export function drawPreview(c: CanvasRenderingContext2D, v: FieldView, path: readonly PathPoint[]): void {
  const points = inPlane(v, path),
    last = points.length - 3;
  if (last < 0) return;
  c.beginPath();
  trace(c, v.camera, points, false);
  c.lineJoin = "round";
  for (const [colour, width] of [
    [v.theme.paper, 6],
    [v.theme.ink, 2.5],
  ] as const) {
    c.strokeStyle = colour;
    c.lineWidth = width;
    c.stroke();
  }
  if (!v.camera.project(points[last], points[last + 1], points[last + 2])) return;
  c.beginPath();
  c.arc(v.camera.x, v.camera.y, 5, 0, 7);
  c.fillStyle = v.theme.paper;
  c.fill();
  c.stroke();
}
