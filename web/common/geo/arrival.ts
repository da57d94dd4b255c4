// SPDX-License-Identifier: Apache-2.0
/** When the fire is believed to come to any place, from the belief of now and the forecasts. */
import type { BoundaryPoint } from "../records";
import type { World } from "../world";

const kBand95 = 1.96;

/** Signed distance of a place to rings [m], negative inside, and the sigma of the nearest edge [m]. */
export function distanceToRings(rings: BoundaryPoint[][], north: number, east: number): { distance: number; sigma: number } {
  let least = Infinity,
    sigma = 0,
    inside = false;
  for (const ring of rings)
    for (let i = 0, j = ring.length - 1; i < ring.length; j = i++) {
      const [an, ae, bn, be] = [ring[j].north_m ?? 0, ring[j].east_m ?? 0, ring[i].north_m ?? 0, ring[i].east_m ?? 0];
      if (an > north !== bn > north && east < ((be - ae) * (north - an)) / (bn - an) + ae) inside = !inside;
      const dn = bn - an,
        de = be - ae,
        square = dn * dn + de * de;
      const f = square > 0 ? Math.max(0, Math.min(1, ((north - an) * dn + (east - ae) * de) / square)) : 0;
      const d = Math.hypot(an + f * dn - north, ae + f * de - east);
      if (d < least) {
        least = d;
        sigma = (1 - f) * (ring[j].sigma_m ?? 0) + f * (ring[i].sigma_m ?? 0);
      }
    }
  return { distance: inside ? -least : least, sigma };
}

export interface Asked {
  burns: boolean; // already, as believed
  early: number | null; // [s] of the run; null: not within the forecasts
  middle: number | null;
  late: number | null;
}

/**
 * The times at which the outer end of the 95 % band, the boundary and the inner end reach a place,
 * with the signed distance taken as linear between the belief and the forecasts.
 */
export function askArrival(world: World, north: number, east: number): Asked | null {
  let best: Asked | null = null;
  for (const perimeter of world.perimeters.values()) {
    const steps = [{ time: perimeter.belief_time_s, ...distanceToRings(perimeter.belief_rings, north, east) }];
    for (const forecast of world.forecasts.get(perimeter.mission)?.values() ?? [])
      if (forecast.boundary_time_s > perimeter.belief_time_s)
        steps.push({ time: forecast.boundary_time_s, ...distanceToRings(forecast.boundary_rings, north, east) });
    steps.sort((a, b) => a.time - b.time);
    const when = (k: number): number | null => {
      const value = (i: number) => steps[i].distance + k * steps[i].sigma;
      if (value(0) <= 0) return steps[0].time;
      for (let i = 1; i < steps.length; ++i)
        if (value(i) <= 0) return steps[i - 1].time + ((steps[i].time - steps[i - 1].time) * value(i - 1)) / (value(i - 1) - value(i));
      return null;
    };
    const asked = { burns: steps[0].distance <= 0, early: when(-kBand95), middle: when(0), late: when(kBand95) };
    if (!best || asked.burns || (asked.middle ?? Infinity) < (best.middle ?? Infinity)) best = asked;
  }
  return best;
}
