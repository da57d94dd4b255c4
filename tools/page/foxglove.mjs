// SPDX-License-Identifier: Apache-2.0
// Watches a run by Foxglove's own client, and holds what it is sent against Foxglove's
// own schemas:   run foxglove.mjs PROGRAM SCENARIO FOLDER
import { mkdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { check, serve } from "./program.mjs";

const require = createRequire(import.meta.url);
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const schemas = require("@foxglove/schemas/jsonschema");
const { WebSocket } = require("ws");

const [program, scenario, folder] = process.argv.slice(2);
if (!folder) throw new Error("usage: foxglove.mjs PROGRAM SCENARIO FOLDER");
mkdirSync(folder, { recursive: true });

/** What of a value a schema does not allow; empty: nothing. */
function faultsOf(value, schema, where) {
  if (schema.oneOf) return schema.oneOf.some(({ const: one }) => one === value) ? [] : [`${where}: ${value}`];
  const type = Array.isArray(value) ? "array" : Number.isInteger(value) ? "integer" : typeof value;
  const fits = !schema.type || type === schema.type || (schema.type === "number" && type === "integer");
  if (!fits) return [`${where} is ${type}, not ${schema.type}`];
  const faults = (schema.required ?? []).filter((key) => !(key in value)).map((key) => `${where} has no ${key}`);
  if (type === "array" && schema.items && !Array.isArray(schema.items))
    value.forEach((each, i) => faults.push(...faultsOf(each, schema.items, `${where}[${i}]`)));
  if (type === "object")
    for (const [key, each] of Object.entries(value)) {
      if (schema.properties?.[key]) faults.push(...faultsOf(each, schema.properties[key], `${where}.${key}`));
      else if (schema.properties) faults.push(`${where}.${key} is unknown`);
    }
  return faults;
}

const run = await serve(program, "run", scenario, "--serve", "0", "--speed", "30", "--overwrite", "--out", join(folder, "foxglove-run"));
try {
  for (const protocol of [FoxgloveClient.SUPPORTED_SUBPROTOCOL, "foxglove.sdk.v1"]) {
    const socket = new WebSocket(run.place.replace("http", "ws"), [protocol]);
    const client = new FoxgloveClient({ ws: socket });
    const channels = new Map(), subscribed = new Map(), said = new Map();
    const errors = [];
    client.on("error", (error) => errors.push(String(error)));
    client.on("status", ({ message }) => errors.push(message));
    client.on("advertise", (all) => {
      for (const channel of all) {
        if (channels.has(channel.id)) errors.push(`${channel.topic} is advertised twice`);
        channels.set(channel.id, channel);
        subscribed.set(client.subscribe(channel.id), channel);
      }
    });
    client.on("message", ({ subscriptionId, timestamp, data }) => {
      const { topic } = subscribed.get(subscriptionId);
      const all = said.get(topic) ?? [];
      if (all.length < 50) all.push({ timestamp, value: JSON.parse(new TextDecoder().decode(data)) });
      said.set(topic, all);
    });
    const wanted = ["/tf", "/aircraft", "/perimeter", "/perimeter/map", "/plans", "/zones/map", "/clock", "/metrics", "/log",
      "/aircraft/scout-1/location", "/aircraft/scout-1/state"];
    const begin = Date.now(), has = (topic) => (said.get(topic)?.length ?? 0) > 0;
    // Until a boundary is believed too.
    const complete = () => wanted.every(has) && said.get("/perimeter").some(({ value }) => value.entities.length > 0) &&
      said.get("/plans").some(({ value }) => value.entities.length > 0);
    while (!complete() && Date.now() - begin < 120000) await new Promise((resolve) => setTimeout(resolve, 100));
    check(complete(), `${protocol}: messages of ${wanted.filter(has)} (missing: ${wanted.filter((each) => !has(each))})`);
    check(errors.length === 0, `${protocol}: no errors ${errors}`);
    for (const { topic, schemaName } of channels.values()) {
      const official = schemas[schemaName.replace("foxglove.", "")];
      if (!schemaName.startsWith("foxglove.")) continue;
      const faults = (said.get(topic) ?? []).flatMap(({ value }) => faultsOf(value, official, topic));
      check(faults.length === 0, `${protocol}: ${topic} is as ${schemaName} says ${faults.slice(0, 3)}`);
    }
    const { features } = JSON.parse(said.get("/perimeter/map").at(-1).value.geojson);
    check(features.every(({ type, geometry }) => type === "Feature" && geometry.coordinates.length > 0), "the boundary is on a map");
    const times = said.get("/tf").map(({ timestamp }) => timestamp);
    check(times.every((time, i) => i === 0 || time >= times[i - 1]), "time goes on");
    client.close();
  }
} finally {
  await run.stop();
}
