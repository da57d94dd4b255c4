// SPDX-License-Identifier: Apache-2.0
/** Events are shown as what is said of their kinds has it. */
import assert from "node:assert/strict";
import { test } from "node:test";
import { eventKind, eventLook, isBad } from "../common/events";
import { eventKinds } from "../common/records";

const look = (kind: string, sender = "") => eventLook({ kind, sender });

test("what is lost or in danger stands out, what goes as it is to does not", () => {
  for (const name of ["accident", "wrong-vehicle", "not-commandable"]) assert.equal(eventKind(name).severity, "alarm");
  for (const name of ["accident", "wrong-vehicle", "failsafe", "task-refused", "separation-lost"]) assert.deepEqual(look(name), { row: 0, shape: "triangle" });
  for (const name of ["joined", "took-off", "task-done", "crossing"]) assert.deepEqual(look(name), { row: 2, shape: "dot" });
  assert.deepEqual(look("command", "client 1"), { row: 1, shape: "square" });
  for (const name of ["zone-on", "mission", "team-merged", "clear-of-traffic"]) assert.deepEqual(look(name), { row: 1, shape: "square" });
});

test("an event of a plugin is plain, whatever it is called", () => {
  for (const name of ["smoke-note", "my-refused", "toString", "constructor", ""]) {
    assert.equal(eventKind(name), eventKinds.plugin);
    assert.equal(isBad(name), false);
    assert.equal(look(name).shape, "dot");
  }
});
