// SPDX-License-Identifier: Apache-2.0
/** The belief, its 95 % band and the forecasts as features. */
import type { BoundaryPoint } from "../../common/records";
import type { World } from "../../common/world";
import type { Feature, Ring } from "./features";

const kBand95 = 1.96;

function shifted(ring: BoundaryPoint[], k: number): Ring {
  return ring.map((p) => {
    const reach = k * (p.sigma_m ?? 0);
    return [(p.north_m ?? 0) + reach * (p.normal_north ?? 0), (p.east_m ?? 0) + reach * (p.normal_east ?? 0)];
  });
}

function boundary(name: string, rings: BoundaryPoint[][], properties: Feature["properties"]): Feature[] {
  return (
    [
      ["", 0],
      [" 95 % outer", kBand95],
      [" 95 % inner", -kBand95],
    ] as const
  ).map(([suffix, k]) => ({
    name: name + suffix,
    geometry: { kind: "area", rings: rings.map((ring) => shifted(ring, k)) },
    properties: { ...properties, prob: k === 0 ? 0.5 : k > 0 ? 0.025 : 0.975 },
  }));
}

export function fireFeatures(world: World): Feature[] {
  const out: Feature[] = [];
  for (const p of world.perimeters.values()) out.push(...boundary(`${p.mission} perimeter`, p.belief_rings, { mission: p.mission, time_s: p.belief_time_s }));
  for (const all of world.forecasts.values())
    for (const f of all.values()) {
      const ahead = Math.round((f.boundary_time_s - f.made_s) / 60);
      out.push(
        ...boundary(`${f.mission} in ${ahead} min`, f.boundary_rings, { mission: f.mission, time_s: f.boundary_time_s, made_s: f.made_s, ahead_min: ahead }),
      );
    }
  return out;
}
