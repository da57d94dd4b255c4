// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { Frame, latitudeOfMercator, mercatorY, mgrsText, toUtm } from "../common/frames";

const frame = new Frame({ latitude_deg: 36.6, longitude_deg: -121.6, height_m: 25 });

test("places come back through latitude and longitude", () => {
  for (const [north, east] of [
    [0, 0],
    [5000, -3000],
    [-12000, 9000],
    [1, 1],
  ]) {
    const [lng, lat] = frame.toLngLat(north, east);
    const { north_m, east_m } = frame.toLocal({ latitude_deg: lat, longitude_deg: lng });
    // toLngLat stays on the tangent plane, toLocal looks up the same point: a micrometre of rounding.
    assert.ok(Math.hypot(north_m - north, east_m - east) < 1e-5, `${north},${east}: off by ${Math.hypot(north_m - north, east_m - east)}`);
  }
});

test("a kilometre north is a kilometre along the meridian", () => {
  // Radius of curvature of the meridian at 36.6 degrees and 25 m: M + h.
  const s = Math.sin((36.6 * Math.PI) / 180),
    e2 = 0.00669437999014;
  const radius = (6378137 * (1 - e2)) / Math.pow(1 - e2 * s * s, 1.5) + 25;
  const { latitude_deg } = frame.toLatLon(1000, 0);
  assert.ok(Math.abs((((latitude_deg - 36.6) * Math.PI) / 180) * radius - 1000) < 1e-3); // the radius itself changes by 5 m on the way
});

test("the plane of the map is Mercator about the origin", () => {
  const out = new Float64Array(2);
  frame.toPlane(3000, -2000, out, 0);
  const [lng, lat] = frame.toLngLat(3000, -2000);
  assert.ok(Math.abs(out[0] * frame.mercatorPerMetre + frame.mercatorX - (lng / 360 + 0.5)) < 1e-14);
  assert.ok(Math.abs(out[1] * frame.mercatorPerMetre + frame.mercatorY - mercatorY(lat)) < 1e-14);
  assert.ok(Math.abs(latitudeOfMercator(mercatorY(36.6)) - 36.6) < 1e-12);
});

test("UTM on the central meridian is the scaled meridian arc", () => {
  // Quarter of the meridian: 10001965.729 m; at 45 degrees 4984944.378 m ([Karney11], any geodesy text).
  const at = toUtm({ latitude_deg: 45, longitude_deg: 3 })!;
  assert.equal(at.zone, 31);
  assert.ok(Math.abs(at.easting_m - 500000) < 1e-6);
  assert.ok(Math.abs(at.northing_m - 0.9996 * 4984944.378) < 1e-3);
  assert.ok(Math.abs(toUtm({ latitude_deg: -45, longitude_deg: 3 })!.northing_m - (1e7 - 0.9996 * 4984944.378)) < 1e-3);
});

test("UTM off the meridian: finite differences are conformal with scale about 0.9996", () => {
  const at = (lat: number, lng: number) => toUtm({ latitude_deg: lat, longitude_deg: lng })!;
  const d = 1e-5,
    lat = 36.6,
    lng = -121.6;
  const [n1, n0, e1, e0] = [at(lat + d, lng), at(lat - d, lng), at(lat, lng + d), at(lat, lng - d)];
  const s = Math.sin((lat * Math.PI) / 180),
    e2 = 0.00669437999014,
    w = Math.sqrt(1 - e2 * s * s);
  const m = ((6378137 * (1 - e2)) / (w * w * w)) * ((2 * d * Math.PI) / 180),
    n = (6378137 / w) * Math.cos((lat * Math.PI) / 180) * ((2 * d * Math.PI) / 180);
  const kNorth = Math.hypot(n1.easting_m - n0.easting_m, n1.northing_m - n0.northing_m) / m;
  const kEast = Math.hypot(e1.easting_m - e0.easting_m, e1.northing_m - e0.northing_m) / n;
  assert.ok(Math.abs(kNorth - kEast) < 1e-6, `${kNorth} ${kEast}`);
  assert.ok(kNorth > 0.9996 && kNorth < 1);
});

test("MGRS letters: zones, exceptions, squares", () => {
  assert.equal(toUtm({ latitude_deg: 60, longitude_deg: 5 })!.zone, 32); // Norway
  assert.equal(toUtm({ latitude_deg: 78, longitude_deg: 16 })!.zone, 33); // Svalbard
  assert.equal(toUtm({ latitude_deg: 85, longitude_deg: 16 }), null);
  // The Greenwich meridian on the equator: 31N AA 66021 00000.
  assert.equal(mgrsText({ latitude_deg: 1e-9, longitude_deg: 0 }), "31N AA 66021 00000");
  assert.match(mgrsText({ latitude_deg: 38.8977, longitude_deg: -77.0365 }), /^18S UJ 2339\d 0739\d$/); // the White House
});
