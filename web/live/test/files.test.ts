import assert from "node:assert/strict";
import { test } from "node:test";
import { Frame } from "../frames";
import type { Feature } from "../geo/features";
import { readFeatures, toGeoJson, toKml, toPlan } from "../geo/files";

const frame = new Frame({ latitude_deg: 36.6, longitude_deg: -121.6, height_m: 0 });
const features: Feature[] = [
  { name: "a <b> & \"c\"", geometry: { kind: "area", rings: [[[0, 0], [100, 0], [100, 100], [0, 100]]] }, properties: { prob: 0.5 } },
  { name: "line", geometry: { kind: "line", points: [[0, 0], [50, 80]] }, properties: {} },
  { name: "point", geometry: { kind: "point", at: [-20, 30] }, properties: {} },
];

test("GeoJSON comes back as it went, to the centimetre of its digits", () => {
  const { features: read, left } = readFeatures(toGeoJson(features, frame), frame);
  assert.equal(left, 0);
  assert.deepEqual(read.map(({ name }) => name), features.map(({ name }) => name));
  const ring = read[0].geometry.kind === "area" ? read[0].geometry.rings[0] : [];
  assert.equal(ring.length, 4);
  for (const [north, east] of ring) assert.ok(Math.min(Math.abs(north), Math.abs(north - 100)) < 0.01 && Math.min(Math.abs(east), Math.abs(east - 100)) < 0.01);
});

test("outer rings run against the clock, as RFC 7946 wants", () => {
  const ring = (JSON.parse(toGeoJson(features, frame)) as { features: { geometry: { coordinates: [number, number][][] } }[] }).features[0].geometry.coordinates[0];
  let area = 0;
  for (let i = 0; i + 1 < ring.length; ++i) area += ring[i][0] * ring[i + 1][1] - ring[i + 1][0] * ring[i][1];
  assert.ok(area > 0);
  assert.deepEqual(ring[0], ring[ring.length - 1]);
});

test("a .plan comes back: lines and points as one route, areas as fences", () => {
  const { features: read, left } = readFeatures(toPlan(features, frame, 80), frame);
  assert.equal(left, 0);
  const route = read.find(({ geometry }) => geometry.kind === "line")!.geometry, fence = read.find(({ geometry }) => geometry.kind === "area")!.geometry;
  const expected = [[0, 0], [50, 80], [-20, 30]];
  (route.kind === "line" ? route.points : []).forEach(([north, east], i) => assert.ok(Math.hypot(north - expected[i][0], east - expected[i][1]) < 0.01));
  assert.equal(fence.kind === "area" ? fence.rings[0].length : 0, 4);
  const item = (JSON.parse(toPlan(features, frame, 80)) as { mission: { items: { params: number[] }[] } }).mission.items[0];
  assert.equal(item.params[6], 80);
});

test("what was typed is escaped in KML", () => {
  const kml = toKml(features, frame);
  assert.ok(!kml.includes("<b>"));
  assert.ok(kml.includes("a &#60;b&#62; &#38; &#34;c&#34;"));
});

test("other geometries are taken apart or left out; nonsense throws", () => {
  const text = JSON.stringify({ type: "FeatureCollection", features: [
    { type: "Feature", properties: null, geometry: { type: "MultiPoint", coordinates: [[-121.6, 36.6], [-121.61, 36.61]] } },
    { type: "Feature", properties: {}, geometry: null }, { type: "Feature", properties: {}, geometry: { type: "Point", coordinates: ["x", 1] } }] });
  const { features: read, left } = readFeatures(text, frame);
  assert.equal(read.length, 2);
  assert.equal(left, 2);
  assert.throws(() => readFeatures("no JSON", frame));
});

test("a .plan gives its route, surveys and fences", () => {
  const item = (lat: number, lng: number, command = 16) => ({ type: "SimpleItem", command, params: [0, 0, 0, null, lat, lng, 50] });
  const { features: read, left } = readFeatures(JSON.stringify({ fileType: "Plan", version: 1,
    mission: { items: [item(36.6, -121.6, 22), item(36.6, -121.6), item(36.61, -121.6), { type: "ComplexItem", polygon: [[36.6, -121.6], [36.61, -121.6], [36.61, -121.59]] }] },
    geoFence: { polygons: [], circles: [{ circle: { center: [36.6, -121.6], radius: 100 } }] } }), frame);
  assert.deepEqual(read.map(({ name }) => name), ["survey", "route", "fence"]);
  assert.equal(left, 1);
  const fence = read[2].geometry.kind === "area" ? read[2].geometry.rings[0] : [];
  assert.ok(fence.every(([north, east]) => Math.abs(Math.hypot(north, east) - 100) < 1e-3));
});
