// SPDX-License-Identifier: Apache-2.0
/** Alerts, bands and recommendations of a run at a time. */
import type { Alerting, BandRow } from "./data";

/** What bands and levels of alerts stand for, by their numbers. */
export const kRegions = ["NONE", "FAR", "MID", "NEAR", "RECOVERY"] as const;
export type Region = (typeof kRegions)[number];

const kBandsShown = 10; // rows are a second apart, in long runs more [s]

/** The last of `list` that is not after `time`; -1: none. */
function lastBefore(list: { length: number }, at: (i: number) => number, time: number): number {
  let low = -1,
    high = list.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (at(middle) <= time + 1e-3) low = middle;
    else high = middle;
  }
  return low;
}

type Alert = Alerting["alerts"][number];
export type ShownRecommendation = { reason: string; state: string; path: Alerting["recommendations"][number]["path"] };

export class Alerts {
  private readonly byTrack = new Map<string, Alert[]>();
  private readonly byAircraft = new Map<number, Alert[]>();
  private readonly bandRows = new Map<number, BandRow[]>();
  private readonly shown = new Map<number, Alerting["recommendations"]>();

  constructor(alerting: Alerting) {
    const put = <K, V>(map: Map<K, V[]>, key: K, value: V) => {
      const list = map.get(key);
      if (list) list.push(value);
      else map.set(key, [value]);
    };
    for (const alert of alerting.alerts) {
      put(this.byTrack, `${alert.entity_id} ${alert.track}`, alert);
      put(this.byAircraft, alert.entity_id, alert);
    }
    for (const { entity, rows } of alerting.bands) this.bandRows.set(entity, rows);
    for (const each of alerting.recommendations) put(this.shown, each.entity_id, each);
  }

  /** Aircraft that were alerted or had something recommended. */
  aircraft(): number[] {
    return [...new Set([...this.byAircraft.keys(), ...this.shown.keys()])].sort((a, b) => a - b);
  }

  /** The alert of an aircraft about a track; null where none stands. */
  alert(believer: number, track: number, time: number): Alert | null {
    const list = this.byTrack.get(`${believer} ${track}`);
    if (!list) return null;
    const i = lastBefore(list, (k) => list[k].time_s, time);
    return i >= 0 && list[i].level > 0 ? list[i] : null;
  }

  /** The alerts that stand for an aircraft, highest first. */
  standing(aircraft: number, time: number): Alert[] {
    const newest = new Map<number, Alert>();
    for (const alert of this.byAircraft.get(aircraft) ?? []) {
      if (alert.time_s > time + 1e-3) break;
      newest.set(alert.track, alert);
    }
    return [...newest.values()].filter((alert) => alert.level > 0).sort((a, b) => b.level - a.level);
  }

  /** How the highest alert of an aircraft changes: times and regions, null for none. */
  levels(aircraft: number): { time: number; level: number; region: Region | null }[] {
    const standing = new Map<number, Alert>();
    return (this.byAircraft.get(aircraft) ?? []).map((alert) => {
      if (alert.level > 0) standing.set(alert.track, alert);
      else standing.delete(alert.track);
      const highest = [...standing.values()].reduce<Alert | null>((best, each) => (!best || each.level > best.level ? each : best), null);
      return { time: alert.time_s, level: highest?.level ?? 0, region: highest?.region ?? null };
    });
  }

  /** What an aircraft may fly; null while no alert stands. */
  bands(aircraft: number, time: number): BandRow | null {
    const rows = this.bandRows.get(aircraft);
    if (!rows) return null;
    const i = lastBefore(rows, (k) => rows[k][0], time);
    return i >= 0 && rows[i][1] > 0 && time - rows[i][0] <= kBandsShown ? rows[i] : null;
  }

  /** The path that is recommended to the pilot of an aircraft, and what becomes of it. */
  recommendation(aircraft: number, time: number): ShownRecommendation | null {
    const list = this.shown.get(aircraft);
    if (!list) return null;
    const i = lastBefore(list, (k) => list[k].time_s, time);
    if (i < 0 || list[i].state === "over") return null;
    const path = list.find((each) => each.number === list[i].number && each.state === "shown")?.path ?? [];
    return { reason: list[i].reason, state: list[i].state, path };
  }
}
