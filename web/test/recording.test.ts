// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Frame } from "../common/frames";
import { Player } from "../common/player";
import { Recording } from "../common/recording";
import { Tracks } from "../common/tracks";
import { Decoder } from "../common/wire";
import { kTable } from "../common/wire_table";
import { World } from "../common/world";
import { Encoder } from "./encode";

const encoder = new Encoder(kTable);

/** Messages behind each other, each with its time and its length. */
function recording(...messages: [time: number, ...items: object[]][]): ArrayBuffer {
  const parts = messages.map(([time, ...items]) => {
    const message = encoder.message(items),
      part = new Uint8Array(12 + message.length),
      view = new DataView(part.buffer);
    view.setFloat64(0, time, true);
    view.setUint32(8, message.length, true);
    part.set(message, 12);
    return part;
  });
  const all = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all.buffer;
}

const vehicle = (entity_id: number, north_m: number) => ({
  entity_id,
  north_m,
  east_m: 0,
  altitude_msl_m: 100,
  velocity_north_mps: 0,
  velocity_east_mps: 0,
  climb_mps: 0,
  heading_deg: 0,
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
const frame = (time_s: number, north_m: number) => ({ kind: "fleet_frame", time_s, vehicles: [vehicle(2, north_m)] });
const event = (time_s: number) => ({ kind: "event", value: { time_s, entity_id: 2, kind: "mode", text: "" } });
const zone = (time_s: number, in_force: boolean) => ({
  kind: "zone",
  time_s,
  name: "wood",
  in_force,
  from_s: null,
  until_s: null,
  floor_msl_m: null,
  ceiling_msl_m: null,
  area: {
    kind: "ring",
    points: [
      [0, 0],
      [0, 1],
      [1, 1],
    ],
  },
  polygon: [],
});

function make(records: ArrayBuffer, frames: ArrayBuffer) {
  const decoder = new Decoder(kTable),
    player = new Player(100);
  const world = new World(new Frame({ latitude_deg: 36.6, longitude_deg: -121.6, height_m: 0 }), decoder, kTable, { play: player, gap: 1 });
  return { world, recording: new Recording(world, decoder, records, frames) };
}

test("a recording makes the world what it was at any time, forth and back", () => {
  const { world, recording: run } = make(
    recording([0, event(0)], [10, event(10), zone(10, true)], [20, zone(20, false), event(20)]),
    recording([0, frame(0, 0)]),
  );
  const known = (time: number) => {
    run.show(time);
    return `${world.events.map(({ time_s }) => time_s)} ${[...world.zones.keys()]}`;
  };
  assert.equal(known(9.9), "0 ");
  assert.equal(known(10), "0,10 wood");
  assert.equal(known(99), "0,10,20 ");
  assert.equal(known(12), "0,10 wood");
  assert.equal(known(0), "0 ");
});

test("an aircraft is where it was, between the frames around a time, whichever way the time has come", () => {
  const { world, recording: run } = make(new ArrayBuffer(0), recording([0, frame(0, 0)], [1, frame(1, 20)], [2, frame(2, 60)]));
  const out = new Float64Array(4);
  for (const [time, north] of [
    [0.5, 10],
    [1.5, 40],
    [2, 60],
    [0.25, 5],
    [1, 20],
  ]) {
    run.show(time);
    world.fleet.pose(world.fleet.row(2), time, out);
    assert.ok(Math.abs(-out[1] - north) < 0.05 + 0.002 * north, `${-out[1]} at ${time} s`);
  }
});

test("the time of a recording is its player's, whatever clock it is given", () => {
  const { world, recording: run } = make(new ArrayBuffer(0), recording([0, frame(0, 0)], [1, frame(1, 20)]));
  run.show(0.5);
  world.take("run_clock", { time_s: 0.5, duration_s: 100, speed: 60, wanted_speed: 60, paused: true, over: false, misses: 0, headline: "" });
  assert.equal(world.time, 0.5);
  assert.equal(world.play.now(0), 0);
});

test("a recording that was cut is refused", () => {
  const whole = recording([0, event(0)]);
  assert.throws(() => make(whole.slice(0, whole.byteLength - 1), new ArrayBuffer(0)), RangeError);
});

test("a long track has its begin and its end in a bounded number of points", () => {
  const tracks = new Tracks();
  for (let t = 0; t <= 9000; ++t) tracks.add(1, t, 0, 100, t);
  const { points, count, every } = tracks.all.get(1)!;
  assert.ok(count <= 2000 && count > 1000, `${count} points`);
  assert.equal(points[0], 0);
  assert.equal(points[3 * (count - 1)], 9000);
  assert.equal(points[3 * 501] - points[3 * 500], every);
});

test("a player goes on from where it is put, and from the end begins anew", () => {
  const frames: ((now: number) => void)[] = [],
    told: number[] = [];
  let now = 0;
  Object.assign(globalThis, { requestAnimationFrame: (draw: (now: number) => void) => frames.push(draw) });
  performance.now = () => now;
  const player = new Player(100);
  player.listeners.push((time) => told.push(time));
  const pass = () => {
    now += 100;
    for (const draw of frames.splice(0)) draw(now);
  };
  player.seek(1000);
  assert.equal(player.time, 100);
  player.play();
  pass();
  assert.equal(player.time, 6); // 60 times as fast
  player.stand(90);
  pass();
  assert.equal(player.time, 90);
  player.play();
  for (let k = 0; k < 5; ++k) pass();
  assert.equal(player.time, 100);
  assert.equal(player.playing, false);
  assert.equal(told[told.length - 1], 100);
});
