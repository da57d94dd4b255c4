// SPDX-License-Identifier: Apache-2.0
/** Rings and lines in the plane of the map, made once from a record and drawn with any camera. */
import type { BoundaryPoint } from "../records";
import type { Frame } from "../frames";
import type { Projector } from "./projector";

export const kBand95 = 1.96;

/** x, y and height of the ground of each point. */
export type Points = Float64Array;

export type GroundAt = (north: number, east: number) => number;

export class Shaper {
  constructor(
    private readonly frame: Frame,
    private readonly ground: GroundAt,
  ) {}

  private readonly lines = new WeakMap<object, Points>();
  private readonly bands = new WeakMap<object, Band>();

  points(list: readonly (readonly [number, number])[], above = 0): Points {
    const out = new Float64Array(3 * list.length);
    list.forEach(([north, east], i) => {
      this.frame.toPlane(north, east, out, 3 * i);
      out[3 * i + 2] = this.ground(north, east) + above;
    });
    return out;
  }

  /** The same, kept as long as the list is. */
  line(list: [number, number][]): Points {
    let made = this.lines.get(list);
    if (!made) this.lines.set(list, (made = this.points(list)));
    return made;
  }

  band(ring: BoundaryPoint[]): Band {
    let made = this.bands.get(ring);
    if (made) return made;
    const side = (k: number) =>
      this.points(
        ring.map((p) => {
          const reach = k * (p.sigma_m ?? 0);
          return [(p.north_m ?? 0) + reach * (p.normal_north ?? 0), (p.east_m ?? 0) + reach * (p.normal_east ?? 0)] as const;
        }),
      );
    made = { middle: side(0), inner: side(-kBand95), outer: side(kBand95), inner1: side(-1), outer1: side(1) };
    this.bands.set(ring, made);
    return made;
  }

  circle(north: number, east: number, radius: number, above = 0): Points {
    return this.points(
      Array.from({ length: 48 }, (_, k) => {
        const a = (2 * Math.PI * k) / 48;
        return [north + radius * Math.cos(a), east + radius * Math.sin(a)] as const;
      }),
      above,
    );
  }

  one(north: number, east: number, out: Float64Array): void {
    this.frame.toPlane(north, east, out, 0);
    out[2] = this.ground(north, east);
  }
}

/** A believed ring and its ends at 95 % and one sigma. */
export interface Band {
  middle: Points;
  inner: Points;
  outer: Points;
  inner1: Points;
  outer1: Points;
}

/** Adds a line to the path of the context. */
export function trace(context: CanvasRenderingContext2D, camera: Projector, points: Points, closed: boolean): void {
  let down = false;
  for (let i = 0; i < points.length; i += 3) {
    if (!camera.project(points[i], points[i + 1], points[i + 2])) {
      down = false;
      continue;
    }
    if (down) context.lineTo(camera.x, camera.y);
    else context.moveTo(camera.x, camera.y);
    down = true;
  }
  if (closed && down) context.closePath();
}

const corners = new Float64Array(8);

/** Adds the band between two rings: one quadrangle per edge, all turning alike so that overlaps fill once. */
export function traceBand(context: CanvasRenderingContext2D, camera: Projector, { inner, outer }: Pick<Band, "inner" | "outer">): void {
  const n = inner.length / 3;
  for (let i = 0; i < n; ++i) {
    const k = 3 * ((i + 1) % n),
      j = 3 * i;
    if (!camera.project(outer[j], outer[j + 1], outer[j + 2])) continue;
    corners[0] = camera.x;
    corners[1] = camera.y;
    if (!camera.project(outer[k], outer[k + 1], outer[k + 2])) continue;
    corners[2] = camera.x;
    corners[3] = camera.y;
    if (!camera.project(inner[k], inner[k + 1], inner[k + 2])) continue;
    corners[4] = camera.x;
    corners[5] = camera.y;
    if (!camera.project(inner[j], inner[j + 1], inner[j + 2])) continue;
    corners[6] = camera.x;
    corners[7] = camera.y;
    let area = 0;
    for (let c = 0; c < 8; c += 2) area += corners[c] * corners[(c + 3) % 8] - corners[c + 1] * corners[(c + 2) % 8];
    const step = area < 0 ? -2 : 2,
      first = area < 0 ? 6 : 0;
    context.moveTo(corners[first], corners[first + 1]);
    for (let c = 1; c < 4; ++c) context.lineTo(corners[first + c * step], corners[first + c * step + 1]);
    context.closePath();
  }
}
