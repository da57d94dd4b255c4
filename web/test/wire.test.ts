// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { attitude, Decoder, type Table } from "../common/wire";
import { kTable } from "../common/wire_table";
import { Encoder } from "./encode";

const message = (items: object[], table: Table = kTable) => new Encoder(table).message(items).buffer as ArrayBuffer;

function decode(items: object[], table: Table = kTable): [string, any][] {
  // eslint-disable-line
  const out: [string, unknown][] = [];
  new Decoder(table).decode(message(items, table), (kind, value) => out.push([kind, value]));
  return out as [string, any][];
}

test("values come back as they were written", () => {
  const clock = {
    kind: "run_clock",
    time_s: 12.5,
    duration_s: 3600,
    speed: 0.998,
    wanted_speed: 1,
    paused: false,
    over: false,
    misses: 300,
    headline: "über 24 m",
  };
  const { kind, ...fields } = clock;
  assert.deepEqual(decode([clock]), [[kind, fields]]);
});

test("degrees, heights and nested structs have the names and signs of their descriptions", () => {
  const perimeter = {
    kind: "perimeter",
    time_s: 1,
    believer_id: 1,
    truth: [
      [
        [1, 2],
        [3, 4],
        [5, 6],
      ],
    ],
    belief_time_s: 0.5,
    belief_rings: [
      [{ north_m: 1, east_m: 2, normal_north: 1, normal_east: 0, sigma_m: 9, sigma_growth_mps: 0, rate_mps: 0.3, major_axis_north_m: 0, major_axis_east_m: 0 }],
    ],
    mission: "perimeter",
    phenomenon: 0,
  };
  const [[, read]] = decode([perimeter]);
  assert.equal(read.belief_time_s, 0.5);
  assert.deepEqual(read.truth, perimeter.truth);
  assert.deepEqual(read.belief_rings, perimeter.belief_rings);
  const [[, alert]] = decode([
    {
      kind: "alert",
      time_s: 1,
      entity_id: 300,
      track: 1,
      level: 2,
      region: "MID",
      bearing_deg: 40,
      distance_m: 820,
      height_m: 60,
      track_advised_deg: null,
      speed_advised_mps: 20,
      vertical_speed_advised_mps: null,
    },
  ]);
  assert.equal(alert.entity_id, 300);
  assert.ok(Math.abs(alert.bearing_deg - 40) < 1e-9);
  assert.equal(alert.track_advised_deg, null);
  assert.equal(alert.region, "MID");
});

test("choices carry their kind; a struct with a kind of its own stands under value", () => {
  const [[, order], [, zone], [, command]] = decode([
    {
      kind: "message",
      from_id: 0,
      to_id: 2,
      number: 3,
      sent_s: 1,
      arrived_s: 1,
      content: { kind: "task", task_number: 3, what: { kind: "fly_to", north_m: 500, east_m: -200, altitude_msl_m: null } },
    },
    {
      kind: "zone",
      time_s: 1,
      number: 1,
      in_force: true,
      name: "z",
      area: {
        kind: "ring",
        points: [
          [0, 0],
          [1, 0],
          [0, 1],
        ],
      },
      floor_msl_m: null,
      ceiling_msl_m: 700,
      from_s: null,
      until_s: 9,
    },
    { kind: "command", value: { time_s: 1, sender: "client 1", kind: "speed", factor: 10 } },
  ]);
  assert.deepEqual(order.content.what, { kind: "fly_to", north_m: 500, east_m: -200, altitude_msl_m: null });
  assert.deepEqual(zone.area, {
    kind: "ring",
    points: [
      [0, 0],
      [1, 0],
      [0, 1],
    ],
  });
  assert.equal(zone.until_s, 9);
  assert.deepEqual({ sender: command.sender, kind: command.kind, factor: command.factor }, { sender: "client 1", kind: "speed", factor: 10 });
});

test("a reader passes over fields and kinds that it does not know", () => {
  const newer: Table = structuredClone(kTable);
  newer.structs.Event.push(["severity", "f64"]);
  newer.choices.LiveItem.push(["later", "@Event"]);
  const event = { time_s: 1, entity_id: 2, kind: "task", text: "t", severity: 3 };
  const out: [string, unknown][] = [];
  new Decoder(kTable).decode(
    message(
      [
        { kind: "later", value: event },
        { kind: "event", value: event },
      ],
      newer,
    ),
    (kind, value) => out.push([kind, value]),
  );
  assert.equal(out.length, 1);
  const numbers = { other_id: null, task: null, team_task: null, value: null, threshold: null };
  assert.deepEqual(out[0], ["event", { time_s: 1, entity_id: 2, kind: "task", text: "t", ...numbers }]);
});

test("bytes that end too early throw, whatever they are", () => {
  const whole = new Uint8Array(message([{ kind: "event", value: { time_s: 1, entity_id: 2, kind: "task", text: "text" } }]));
  for (let length = 1; length < whole.length; ++length)
    assert.throws(() => new Decoder(kTable).decode(whole.slice(0, length).buffer, () => undefined), RangeError, `length ${length}`);
  let state = 1;
  for (let k = 0; k < 3000; ++k) {
    const bytes = Uint8Array.from({ length: 40 }, () => (state = (state * 48271) % 2147483647) & 255);
    bytes[0] = 1;
    try {
      new Decoder(kTable).decode(bytes.buffer, () => undefined);
    } catch (problem) {
      assert.ok(problem instanceof RangeError, String(problem));
    }
  }
});

test("rows of numbers have a column for each scalar", () => {
  const decoder = new Decoder(kTable),
    columns = decoder.columns("VehicleView");
  const row = new Float64Array(columns.width);
  const vehicle = {
    entity_id: 7,
    north_m: 1,
    east_m: 2,
    altitude_msl_m: 300,
    velocity_north_mps: 1,
    velocity_east_mps: 2,
    climb_mps: -3,
    heading_deg: 90,
    roll_deg: -5,
    position_sd_m: 1,
    cross_track_m: 0,
    time_error_s: 0,
    charge: 0.5,
    endurance_s: null,
    age_s: 0.1,
    heard_s: 4,
    mode: "auto",
    failsafe: "link",
    reaction: "return",
    on_ground: true,
  };
  decoder.take("fleet_frame", (reader) => {
    reader.uint();
    assert.equal(reader.time(), 5);
    assert.equal(reader.uint(), 1);
    columns.read(reader, row, 0);
  });
  decoder.decode(message([{ kind: "fleet_frame", time_s: 5, vehicles: [vehicle] }]), () => assert.fail("taken"));
  const get = (name: string) => row[columns.names.indexOf(name)];
  assert.equal(get("altitude_msl_m"), 300);
  assert.equal(get("climb_mps"), -3);
  assert.ok(Math.abs(get("heading_deg") - 90) < 1e-9);
  assert.ok(Number.isNaN(get("endurance_s")));
  assert.equal(get("heard_s"), 4);
  assert.equal(columns.words[columns.names.indexOf("failsafe")]![get("failsafe")], "link");
});

test("an attitude is heading, roll and pitch", () => {
  const [heading, roll, pitch] = attitude(Math.SQRT1_2, 0, 0, -Math.SQRT1_2);
  assert.ok(Math.abs(heading - 270) < 1e-9 && Math.abs(roll) < 1e-9 && Math.abs(pitch) < 1e-9);
});
