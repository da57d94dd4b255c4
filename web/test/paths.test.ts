// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";
import { ahead } from "../common/map/paths";

const path = [0, 10, 20].map((ahead_s) => ({ ahead_s, north_m: 0, east_m: 10 * ahead_s, altitude_msl_m: 100 + ahead_s }));
const points = Float64Array.from(path.flatMap(({ east_m, altitude_msl_m }) => [east_m, 0, altitude_msl_m]));

test("what is flown of a path is not drawn any more", () => {
  assert.deepEqual([...ahead(path, points, -1)], [...points]);
  assert.deepEqual([...ahead(path, points, 0)], [...points]);
  assert.deepEqual([...ahead(path, points, 5)], [50, 0, 105, 100, 0, 110, 200, 0, 120]);
  assert.deepEqual([...ahead(path, points, 15)], [150, 0, 115, 200, 0, 120]);
  assert.equal(ahead(path, points, 20).length, 0);
  assert.equal(ahead(path, points, 99).length, 0);
});
