// SPDX-License-Identifier: Apache-2.0
/** What the pilot of an aircraft has around, at the time that the world is of. */
import type { World } from "../common/world";
import type { Alerts } from "./alerts";

export interface Pose {
  north: number;
  east: number;
  heading: number; // [rad]
  altitude: number; // above mean sea level [m]
}

/** How an aircraft of ours flies, by its own estimate. */
export interface OwnShip {
  pose: Pose;
  track: number; // over ground [rad]
  speed: number; // over ground [m/s]
  climb: number; // [m/s]
}

/** Another aircraft as one of ours believes it. */
export interface Believed {
  track: number;
  north: number;
  east: number;
  altitude: number;
  velocity: [number, number, number]; // north, east, up [m/s]
  deviation: number; // [m]
}

const kBelievedFor = 3; // a track that is not renewed is shown for so long [s]
const kStands = 0.1; // slower than this it has no track over ground [m/s]

/** Aircraft that have followed another one by the time of the world. */
export function believers(world: World): Set<number> {
  return new Set([...world.trafficTracks.values()].map(({ believer_id }) => believer_id));
}

export class Cockpit {
  private readonly pose = new Float64Array(4);

  constructor(
    private readonly world: World,
    readonly alerts: Alerts,
    readonly aircraft: number,
  ) {}

  get name(): string {
    return this.world.name(this.aircraft);
  }

  /** Null when it does not fly at this time. */
  own(time: number): OwnShip | null {
    const row = this.world.fleet.row(this.aircraft);
    return row < 0 ? null : this.flight(row, time);
  }

  /** The own team, without this aircraft. */
  team(time: number): { name: string; pose: Pose }[] {
    const { fleet } = this.world;
    return Array.from({ length: fleet.count }, (_, row) => row)
      .filter((row) => fleet.ids[row] !== this.aircraft)
      .map((row) => ({ name: this.world.name(fleet.ids[row]), pose: this.flight(row, time).pose }));
  }

  /** Intruders, as this aircraft believes them. */
  traffic(time: number): Believed[] {
    return [...this.world.trafficTracks.values()]
      .filter(({ believer_id, time_s }) => believer_id === this.aircraft && time - time_s < kBelievedFor + this.world.gap)
      .map((each) => {
        const age = time - each.time_s;
        const velocity: [number, number, number] = [each.velocity_north_mps ?? 0, each.velocity_east_mps ?? 0, each.climb_mps ?? 0];
        return {
          track: each.track,
          velocity,
          deviation: each.horizontal_sd_m ?? 0,
          north: (each.north_m ?? 0) + age * velocity[0],
          east: (each.east_m ?? 0) + age * velocity[1],
          altitude: (each.altitude_msl_m ?? 0) + age * velocity[2],
        };
      });
  }

  // Frames are of a moment later at most: it is gone back from them.
  private flight(row: number, time: number): OwnShip {
    const { fleet } = this.world,
      back = fleet.time - time,
      value = (name: string) => fleet.get(row, name) || 0;
    const north = value("velocity_north_mps"),
      east = value("velocity_east_mps"),
      climb = value("climb_mps");
    fleet.pose(row, time, this.pose);
    const speed = Math.hypot(north, east),
      [, , altitude, heading] = this.pose;
    return {
      pose: { north: value("north_m") - back * north, east: value("east_m") - back * east, heading, altitude },
      track: speed > kStands ? Math.atan2(east, north) : heading,
      speed,
      climb,
    };
  }
}
