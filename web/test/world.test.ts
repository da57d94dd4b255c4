// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { kMotion, kNow, PlayTime } from "../common/fleet";
import { Frame } from "../common/frames";
import { askArrival, distanceToRings } from "../common/geo/arrival";
import { Decoder } from "../common/wire";
import { kTable } from "../common/wire_table";
import { World } from "../common/world";
import { Encoder } from "./encode";

const vehicle = (entity_id: number, north_m: number, heading_deg = 0) => ({
  entity_id,
  north_m,
  east_m: 0,
  altitude_msl_m: 100,
  velocity_north_mps: 0,
  velocity_east_mps: 0,
  climb_mps: 0,
  heading_deg,
  roll_deg: 0,
  position_sd_m: 1,
  cross_track_m: 0,
  time_error_s: 0,
  charge: 1,
  endurance_s: null,
  age_s: 0,
  heard_s: null,
  mode: "auto",
  failsafe: "none",
  reaction: "none",
  on_ground: false,
});

function make() {
  const decoder = new Decoder(kTable),
    world = new World(new Frame({ latitude_deg: 36.6, longitude_deg: -121.6, height_m: 0 }), decoder, kTable);
  const encoder = new Encoder(kTable);
  return { world, say: (...items: object[]) => decoder.decode(encoder.message(items).buffer as ArrayBuffer, (kind, value) => world.take(kind, value)) };
}

const frame = (time_s: number, ...vehicles: object[]) => ({ kind: "fleet_frame", time_s, vehicles });
const point = (north_m: number, east_m: number, sigma_m = 10) => ({
  north_m,
  east_m,
  normal_north: 0,
  normal_east: 0,
  sigma_m,
  sigma_growth_mps: 0,
  rate_mps: 0,
  major_axis_north_m: 0,
  major_axis_east_m: 0,
});
const square = (r: number, sigma = 10) => [[point(-r, -r, sigma), point(r, -r, sigma), point(r, r, sigma), point(-r, r, sigma)]];

test("a snapshot forgets what was before", () => {
  const { world, say } = make();
  say({ kind: "snapshot", begins: true }, { kind: "event", value: { time_s: 1, entity_id: 1, kind: "a", text: "" } }, frame(1, vehicle(2, 0)));
  assert.equal(world.events.length, 1);
  assert.equal(world.complete, false);
  say({ kind: "snapshot", begins: true }, { kind: "snapshot", begins: false });
  assert.equal(world.events.length, 0);
  assert.equal(world.fleet.count, 0);
  assert.equal(world.complete, true);
});

test("between two frames an aircraft is between, beyond the last at most a second on", () => {
  const { world, say } = make(),
    out = new Float64Array(4);
  say(frame(10, vehicle(2, 0, 350)));
  say(frame(11, vehicle(2, 20, 10)));
  const row = world.fleet.row(2),
    north = (time: number) => {
      world.fleet.pose(row, time, out);
      return -out[1];
    };
  assert.ok(Math.abs(north(10.5) - 10) < 0.05);
  assert.ok(Math.abs(north(11.5) - 30) < 0.1);
  assert.ok(Math.abs(north(20) - 40) < 0.1);
  world.fleet.pose(row, 10.5, out);
  assert.ok(Math.abs(Math.sin(out[3])) < 1e-6 && Math.cos(out[3]) > 0); // from 350 to 10 degrees by way of north
});

test("hundreds of aircraft keep their rows and tails as memory grows", () => {
  const { world, say } = make();
  for (let t = 0; t < 5; ++t) say(frame(t, ...Array.from({ length: 500 }, (_, k) => vehicle(k + 1, k + t))));
  assert.equal(world.fleet.count, 500);
  assert.equal(world.fleet.get(world.fleet.row(400), "north_m"), 403);
  assert.ok(Math.abs(-world.fleet.motion[world.fleet.row(400) * kMotion + kNow + 1] - 403) < 0.01 * 403); // the plane is in metres of a sphere
  assert.equal(world.fleet.tails.length % 1024, 0);
});

test("the time that is drawn never jumps and stays behind the newest frame", () => {
  const play = new PlayTime();
  let wall = 0,
    shown = -1;
  for (let k = 0; k < 300; ++k) {
    wall = 0.1 * k + 0.03 * Math.sin(k); // frames come unevenly
    play.frame(0.4 * k, wall);
    if (k < 30) continue;
    const now = play.now(wall);
    assert.ok(shown < 0 || (now >= shown - 0.2 && now - shown < 1.2), `${shown} to ${now}`);
    assert.ok(now < 0.4 * k + 0.1, `${now} after ${0.4 * k}`);
    shown = now;
  }
});

test("a forecast that is newer replaces all of the older", () => {
  const { world, say } = make();
  const forecast = (made_s: number, boundary_time_s: number) => ({
    kind: "forecast",
    believer_id: 1,
    made_s,
    boundary_time_s,
    boundary_rings: square(200),
    phenomenon: 0,
    mission: "m",
  });
  say(forecast(0, 600), forecast(0, 1800));
  assert.equal(world.forecasts.get("m")!.size, 2);
  say(forecast(600, 1200));
  assert.deepEqual([...world.forecasts.get("m")!.keys()], [1200]);
});

test("the fire comes between the belief and the forecast that has reached the place", () => {
  const { world, say } = make();
  say(
    { kind: "perimeter", time_s: 0, believer_id: 1, truth: [], belief_time_s: 0, belief_rings: square(100), mission: "m", phenomenon: 0 },
    { kind: "forecast", believer_id: 1, made_s: 0, boundary_time_s: 1000, boundary_rings: square(300), phenomenon: 0, mission: "m" },
  );
  const asked = askArrival(world, 200, 0)!;
  assert.equal(asked.burns, false);
  assert.ok(Math.abs(asked.middle! - 500) < 1); // from 100 m outside to 100 m inside
  assert.ok(asked.early! < asked.middle! && asked.late! > asked.middle!);
  assert.equal(askArrival(world, 0, 0)!.burns, true);
  assert.equal(askArrival(world, 2000, 0)!.middle, null);
  assert.ok(Math.abs(distanceToRings(square(100) as never, 150, 0).distance - 50) < 1e-9);
});

test("a link's quality follows what arrives", () => {
  const { world, say } = make();
  const link = (arrived: number, lost: number) => ({
    kind: "radio_link",
    time_s: 1,
    from_id: 1,
    to_id: 2,
    arrived,
    lost,
    rssi_dbm: -60,
    sinr_db: 10,
    delay_s: 0.02,
  });
  say(link(10, 0));
  assert.equal(world.links.get("1 2")!.quality, 1);
  for (let k = 0; k < 30; ++k) say(link(5, 5));
  assert.ok(Math.abs(world.links.get("1 2")!.quality! - 0.5) < 0.01);
});

test("radios that hear each other and have said nothing have no quality", () => {
  const { world, say } = make();
  const link = (arrived: number, lost: number) => ({
    kind: "radio_link",
    time_s: 1,
    from_id: 1,
    to_id: 2,
    arrived,
    lost,
    rssi_dbm: -60,
    sinr_db: null,
    delay_s: null,
  });
  say(link(0, 0));
  assert.equal(world.links.get("1 2")!.quality, null);
  say(link(9, 1));
  assert.equal(world.links.get("1 2")!.quality, 0.9);
  say(link(0, 0));
  assert.equal(world.links.get("1 2")!.quality, 0.9);
});

test("commands of everybody stand among the events, with who gave them", () => {
  const { world, say } = make();
  say({ kind: "command", value: { time_s: 3, sender: "client 2", kind: "fault", aircraft: "scout-1", part: "link", fails: true } });
  assert.equal(world.whose(world.events[0]), "client 2");
  assert.equal(world.events[0].text, "fault scout-1 link");
});
