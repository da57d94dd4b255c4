// SPDX-License-Identifier: Apache-2.0
/** What crosses 180 degrees of longitude, cut there as RFC 7946 3.1.9 asks; as src/skein/geo/antimeridian.h does it. */
import type { Frame } from "../../common/frames";
import type { Ring } from "./features";

type Point = [number, number]; // north and east [m]
export type LngLat = [number, number];

interface Place {
  p: Point;
  at: LngLat;
  east: number; // of 180 degrees, west negative [deg]
}

const kOnIt = 1e-9; // of longitude, 0.1 mm at the equator [deg]
const kMinPart = 1e-4; // of an area [m^2]
const kHalvings = 50;

function placeOf(p: Point, frame: Frame): Place {
  const at = frame.toLngLat(...p);
  const east = at[0] > 0 ? at[0] - 180 : at[0] + 180;
  return Math.abs(east) < kOnIt ? { p, at: [-180, at[1]], east: 0 } : { p, at, east };
}

const isEast = (place: Place) => place.east >= 0;
const crossesZero = (a: Place, b: Place) => Math.abs(a.east - b.east) >= 180;
const crosses = (a: Place, b: Place) => isEast(a) !== isEast(b) && !crossesZero(a, b);
const same = (a: Point, b: Point) => a[0] === b[0] && a[1] === b[1];

/** Where the straight line from a to b crosses. */
function crossing(a: Place, b: Place, frame: Frame): Place {
  if (a.east === 0) return a;
  if (b.east === 0) return b;
  const between = (share: number) => placeOf([a.p[0] + share * (b.p[0] - a.p[0]), a.p[1] + share * (b.p[1] - a.p[1])], frame);
  let from = 0,
    to = 1;
  for (let k = 0; k < kHalvings; ++k) {
    const middle = (from + to) / 2;
    if (isEast(between(middle)) === isEast(a)) from = middle;
    else to = middle;
  }
  return between(to);
}

/** A place on 180 degrees as one side says it. */
const onIt = (place: Place, east: boolean): Place => ({ ...place, at: [east ? -180 : 180, place.at[1]] });

function append(to: Place[], place: Place) {
  if (to.length === 0 || !same(to[to.length - 1].p, place.p)) to.push(place);
}

/** The parts of a line, each of two points or more. */
export function cutLine(points: Ring, frame: Frame): LngLat[][] {
  const places = points.map((p) => placeOf(p, frame));
  const parts: Place[][] = [[]];
  places.forEach((to, k) => {
    const from = places[k - 1];
    if (k > 0 && crosses(from, to)) {
      const on = crossing(from, to, frame);
      append(parts[parts.length - 1], onIt(on, isEast(from)));
      if (parts[parts.length - 1].length < 2) parts.pop();
      parts.push([onIt(on, isEast(to))]);
    }
    append(parts[parts.length - 1], to);
  });
  if (parts.length > 1 && parts[parts.length - 1].length < 2) parts.pop();
  return parts.map((part) => part.map(({ at }) => at));
}

function areaOf(ring: Point[]): number {
  let area = 0;
  ring.forEach(([x, y], k) => {
    const [x2, y2] = ring[(k + 1) % ring.length];
    area += x * y2 - x2 * y;
  });
  return area / 2;
}

function contains(ring: Point[], [x, y]: Point): boolean {
  let inside = false;
  ring.forEach(([x1, y1], k) => {
    const [x2, y2] = ring[(k + 1) % ring.length];
    if (x1 > x !== x2 > x && y < y1 + ((x - x1) / (x2 - x1)) * (y2 - y1)) inside = !inside;
  });
  return inside;
}

/** What lies on one side: rings, and chains that begin and end on 180 degrees. */
interface Side {
  rings: Place[][];
  chains: Place[][];
}

/** False where a ring surrounds a pole. */
function divide(ring: Ring, frame: Frame, sides: { west: Side; east: Side }): boolean {
  const places = ring.map((p) => placeOf(p, frame));
  const edge = (k: number): [Place, Place] => [places[k % places.length], places[(k + 1) % places.length]];
  const edges = places.map((_, k) => edge(k));
  if (edges.some(([a, b]) => crossesZero(a, b))) return false;
  const first = edges.findIndex(([a, b]) => crosses(a, b));
  const side = (place: Place) => (isEast(place) ? sides.east : sides.west);
  if (first < 0) {
    side(places[0]).rings.push(places);
    return true;
  }
  let chain: Place[] = [];
  for (let k = first; k <= first + places.length; ++k) {
    const [a, b] = edge(k);
    if (k > first) append(chain, a);
    if (!crosses(a, b)) continue;
    const on = crossing(a, b, frame);
    if (k > first) {
      append(chain, onIt(on, isEast(a)));
      chain[chain.length - 1] = onIt(chain[chain.length - 1], isEast(a));
      side(a).chains.push(chain);
    }
    chain = [onIt(on, isEast(b))];
  }
  return true;
}

/** Joins chains along 180 degrees: from the south, every second gap is inside. False where ends do not match. */
function close({ rings, chains }: Side): boolean {
  const ends = chains.flatMap((chain, k) => [
    { latitude: chain[0].at[1], k, begins: true },
    { latitude: chain[chain.length - 1].at[1], k, begins: false },
  ]);
  ends.sort((a, b) => a.latitude - b.latitude);
  const next: number[] = [];
  for (let k = 0; k + 1 < ends.length; k += 2) {
    const [a, b] = [ends[k], ends[k + 1]];
    if (a.begins === b.begins) return false;
    next[a.begins ? b.k : a.k] = a.begins ? a.k : b.k;
  }
  const used = new Set<number>();
  chains.forEach((_, first) => {
    const ring: Place[] = [];
    for (let k = first; !used.has(k); k = next[k]) {
      used.add(k);
      for (const each of chains[k]) append(ring, each);
    }
    while (ring.length > 1 && same(ring[0].p, ring[ring.length - 1].p)) ring.pop();
    if (ring.length > 2 && Math.abs(areaOf(ring.map(({ p }) => p))) > kMinPart) rings.push(ring);
  });
  return true;
}

/** An area, its outer ring first, as polygons of which none crosses 180 degrees. */
export function cutArea(rings: Ring[], frame: Frame): LngLat[][][] {
  const uncut = [rings.map((ring) => ring.map((p) => frame.toLngLat(...p)))];
  // Holes run the other way, so that what is inside lies on one hand of every edge.
  const run = rings.map((ring, k) => (areaOf(ring) > 0 === (k === 0) ? ring : [...ring].reverse()));
  const sides = { west: { rings: [], chains: [] }, east: { rings: [], chains: [] } };
  if (!run.every((ring) => ring.length > 0 && divide(ring, frame, sides))) return uncut;
  if (sides.west.chains.length === 0 || !close(sides.west) || !close(sides.east)) return uncut;
  return [sides.west, sides.east].flatMap(({ rings: all }: Side) => {
    const outer = all.filter((ring) => areaOf(ring.map(({ p }) => p)) > 0);
    const holes = all.filter((ring) => areaOf(ring.map(({ p }) => p)) <= 0);
    return outer.map((ring) =>
      [
        ring,
        ...holes.filter((hole) =>
          contains(
            ring.map(({ p }) => p),
            hole[0].p,
          ),
        ),
      ].map((each) => each.map(({ at }) => at)),
    );
  });
}
