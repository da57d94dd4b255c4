// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Frame } from "../common/frames";
import type { Feature } from "../live/geo/features";
import { fromServer, leftOutOfPlan, toGeoJson, toKml, toPlan } from "../live/geo/files";

const frame = new Frame({ latitude_deg: 36.6, longitude_deg: -121.6, height_m: 0 });
const features: Feature[] = [
  {
    name: 'a <b> & "c"',
    geometry: {
      kind: "area",
      rings: [
        [
          [0, 0],
          [100, 0],
          [100, 100],
          [0, 100],
        ],
      ],
    },
    properties: { prob: 0.5 },
  },
  {
    name: "line",
    geometry: {
      kind: "line",
      points: [
        [0, 0],
        [50, 80],
      ],
    },
    properties: {},
  },
  { name: "point", geometry: { kind: "point", at: [-20, 30] }, properties: {} },
];

test("GeoJSON has places to the centimetre of its digits, and what shapes are for", () => {
  const [first] = (
    JSON.parse(toGeoJson([{ ...features[0], purpose: "exclusion" }], frame)) as {
      features: { properties: Record<string, unknown>; geometry: { coordinates: [number, number][][] } }[];
    }
  ).features;
  assert.equal(first.properties.purpose, "exclusion");
  assert.equal(first.geometry.coordinates[0].length, 5);
  for (const [lng, lat] of first.geometry.coordinates[0]) {
    const { north_m, east_m } = frame.toLocal({ latitude_deg: lat, longitude_deg: lng });
    assert.ok(Math.min(Math.abs(north_m), Math.abs(north_m - 100)) < 0.01 && Math.min(Math.abs(east_m), Math.abs(east_m - 100)) < 0.01);
  }
});

test("outer rings run against the clock, as RFC 7946 wants", () => {
  const ring = (JSON.parse(toGeoJson(features, frame)) as { features: { geometry: { coordinates: [number, number][][] } }[] }).features[0].geometry
    .coordinates[0];
  let area = 0;
  for (let i = 0; i + 1 < ring.length; ++i) area += ring[i][0] * ring[i + 1][1] - ring[i + 1][0] * ring[i][1];
  assert.ok(area > 0);
  assert.deepEqual(ring[0], ring[ring.length - 1]);
});

test("what crosses 180 degrees of longitude is cut there", () => {
  const near = new Frame({ latitude_deg: -16.8, longitude_deg: 179.995, height_m: 0 }); // 532 m west of it
  const square = (half: number, east: number): [number, number][] => [
    [half, east - half],
    [half, east + half],
    [-half, east + half],
    [-half, east - half],
  ];
  const {
    features: [area, line, whole],
  } = JSON.parse(
    toGeoJson(
      [
        { name: "area", geometry: { kind: "area", rings: [square(2000, 0), square(100, 532), square(100, 1200)] }, properties: {} },
        {
          name: "line",
          geometry: {
            kind: "line",
            points: [
              [0, 0],
              [100, 1000],
              [200, 900],
              [300, -100],
            ],
          },
          properties: {},
        },
        { name: "whole", geometry: { kind: "area", rings: [square(300, 0)] }, properties: {} },
      ],
      near,
    ),
  ) as { features: { geometry: { type: string; coordinates: unknown } }[] };
  const steps = (points: [number, number][]) => points.slice(1).every(([lng], k) => Math.abs(lng - points[k][0]) < 180);
  const polygons = area.geometry.coordinates as [number, number][][][];
  assert.equal(area.geometry.type, "MultiPolygon");
  assert.deepEqual(
    polygons.map((rings) => rings.length),
    [1, 2],
  ); // one hole lies on 180 degrees, one east of it
  assert.ok(polygons.flat().every(steps));
  const size = (ring: [number, number][]) => {
    const points = ring.map(([longitude_deg, latitude_deg]) => near.toLocal({ latitude_deg, longitude_deg }));
    let sum = 0;
    points.slice(1).forEach((b, k) => {
      sum += points[k].north_m * b.east_m - b.north_m * points[k].east_m;
    });
    return Math.abs(sum / 2);
  };
  const total = polygons.reduce((sum, [outer, ...holes]) => sum + size(outer) - holes.reduce((all, hole) => all + size(hole), 0), 0);
  assert.ok(Math.abs(total - (4000 ** 2 - 2 * 200 ** 2)) < 20);
  const lines = line.geometry.coordinates as [number, number][][];
  assert.equal(line.geometry.type, "MultiLineString");
  assert.deepEqual(
    lines.map((points) => points.length),
    [2, 4, 2],
  );
  assert.ok(lines.every(steps));
  assert.deepEqual(
    lines.map((points) => Math.sign(points[0][0])),
    [1, -1, 1],
  );
  assert.equal(whole.geometry.type, "Polygon");
});

interface Plan {
  mission: { items: { params: number[] }[] };
  geoFence: { polygons: { inclusion: boolean }[]; circles: { inclusion: boolean; circle: { radius: number } }[] };
  rallyPoints: { points: number[][] };
}

test("in a .plan lines and points are one route, drawn areas fences to stay in", () => {
  const plan = JSON.parse(toPlan(features, frame, 80)) as Plan;
  const expected = [
    [0, 0],
    [50, 80],
    [-20, 30],
  ];
  assert.equal(plan.mission.items.length, 3);
  plan.mission.items.forEach(({ params }, i) => {
    const { north_m, east_m } = frame.toLocal({ latitude_deg: params[4], longitude_deg: params[5] });
    assert.ok(Math.hypot(north_m - expected[i][0], east_m - expected[i][1]) < 0.01);
    assert.equal(params[6], 80);
  });
  assert.deepEqual(
    plan.geoFence.polygons.map(({ inclusion }) => inclusion),
    [true],
  );
});

test("what a .plan says something is for stays so", () => {
  const square: [number, number][] = [
    [0, 0],
    [100, 0],
    [100, 100],
    [0, 100],
  ];
  const loaded = fromServer([
    { name: "survey", purpose: "survey", kind: "area", rings: [square], radius_m: null },
    {
      name: "route",
      purpose: "route",
      kind: "line",
      rings: [
        [
          [0, 0],
          [50, 0],
        ],
      ],
      radius_m: null,
    },
    { name: "fence", purpose: "inclusion", kind: "area", rings: [square], radius_m: null },
    { name: "fence", purpose: "exclusion", kind: "area", rings: [square], radius_m: null },
    { name: "fence", purpose: "exclusion", kind: "circle", rings: [[[10, 20]]], radius_m: 40 },
    { name: "rally point", purpose: "rally", kind: "point", rings: [[[0, 150]]], radius_m: null },
  ]);
  const plan = JSON.parse(toPlan(loaded, frame, 80)) as Plan;
  assert.deepEqual(
    plan.geoFence.polygons.map(({ inclusion }) => inclusion),
    [true, false],
  );
  assert.deepEqual(
    plan.geoFence.circles.map(({ inclusion, circle }) => [inclusion, circle.radius]),
    [[false, 40]],
  );
  assert.equal(plan.mission.items.length, 2);
  assert.equal(plan.rallyPoints.points.length, 1);
  assert.equal(leftOutOfPlan(loaded), 1);
  const ring = loaded[4].geometry.kind === "area" ? loaded[4].geometry.rings[0] : [];
  assert.ok(ring.length === 64 && ring.every(([north, east]) => Math.abs(Math.hypot(north - 10, east - 20) - 40) < 1e-9));
});

test("what was typed is escaped in KML", () => {
  const kml = toKml(features, frame);
  assert.ok(!kml.includes("<b>"));
  assert.ok(kml.includes("a &#60;b&#62; &#38; &#34;c&#34;"));
});
