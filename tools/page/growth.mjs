// SPDX-License-Identifier: Apache-2.0
// Memory and speed of a served run over its simulated time, with two who watch:
//   run growth.mjs PROGRAM SCENARIO FOLDER [OPTION OF RUN...]
// Writes FOLDER/growth.csv and FOLDER/growth.svg. Fails when memory is not bounded, when
// simulating an hour costs more and more, or when the server keeps more and more.
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { check, serve } from "./program.mjs";

const { WebSocket } = createRequire(import.meta.url)("ws");
const [program, scenario, folder, ...options] = process.argv.slice(2);
if (!folder) throw new Error("usage: growth.mjs PROGRAM SCENARIO FOLDER [OPTION...]");
mkdirSync(folder, { recursive: true });
const kWatchers = 2, kPeriod = 2000; // [ms]
const kMaxMemory = 1e9; // [bytes]
// Of the last third against the middle one: what repeats itself differs by this at most.
const kMemoryRatio = 1.1, kCostRatio = 1.5, kKeptRatio = 1.1;
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** CPU seconds that a process has used. */
function cpu(pid) {
  const [, fields] = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ");
  const [utime, stime] = fields.split(" ").slice(11, 13).map(Number);
  return (utime + stime) / 100;
}

/** One who watches, and comes back when its connection has ended. */
function watch(place) {
  let ended = false, socket;
  const open = () => {
    socket = new WebSocket(new URL("live", place.replace("http", "ws")), ["skein.live.v1"]);
    socket.on("message", () => {});
    socket.on("error", () => {});
    socket.on("close", () => { if (!ended) setTimeout(open, 1000); });
  };
  open();
  return () => { ended = true; socket.terminate(); };
}

async function measure() {
  const run = await serve(program, "run", scenario, "--serve", "0", "--speed", "fast", "--overwrite",
    "--out", join(folder, "run"), ...options);
  const watchers = Array.from({ length: kWatchers }, () => watch(run.place));
  const samples = [];
  try {
    for (;;) {
      const health = await (await fetch(new URL("api/health", run.place))).json();
      const last = samples.at(-1);
      if (!last || health.time_s > last.time)
        samples.push({ time: health.time_s, memory: health.memory.resident_bytes, cpu: cpu(run.pid),
          kept: health.memory.state_records, unsent: health.memory.unsent_bytes });
      if (health.over) return samples;
      await sleep(kPeriod);
    }
  } finally {
    for (const stop of watchers) stop();
    await run.stop();
  }
}

/** CPU seconds for each simulated hour, at the middle of each of `count` parts of the run. */
function costs(samples, count) {
  const end = samples.at(-1).time, out = [];
  const at = (time) => samples.find((sample) => sample.time >= time) ?? samples.at(-1);
  for (let k = 0; k < count; ++k) {
    const from = at((end * k) / count), to = at((end * (k + 1)) / count);
    if (to.time > from.time)
      out.push({ time: (from.time + to.time) / 2, cost: (3600 * (to.cpu - from.cpu)) / (to.time - from.time) });
  }
  return out;
}

const third = (all, k) => {
  const end = all.at(-1).time;
  return all.filter((one) => one.time > (end * k) / 3 && one.time <= (end * (k + 1)) / 3);
};
const most = (all, value) => Math.max(...all.map(value));
const mean = (all, value) => all.reduce((sum, one) => sum + value(one), 0) / all.length;

/** A line of values over hours, with its axis, in a box of a picture. */
function panel(top, title, points, hours) {
  const left = 60, width = 560, height = 150;
  const high = 1.15 * Math.max(...points.map((p) => p.value));
  const x = (h) => left + (width * h) / hours, y = (v) => top + height - (height * v) / high;
  const step = [1, 2, 3, 6, 12, 24].find((s) => hours / s <= 8) ?? Math.ceil(hours / 8);
  let text = `<text x="${left}" y="${top - 8}" font-weight="bold">${title}</text>
<rect x="${left}" y="${top}" width="${width}" height="${height}" fill="none" stroke="#888"/>\n`;
  for (let h = 0; h <= hours + 1e-9; h += step)
    text += `<text x="${x(h)}" y="${top + height + 15}" text-anchor="middle">${h} h</text>\n`;
  for (let k = 0; k <= 2; ++k)
    text += `<text x="${left - 6}" y="${y((high * k) / 2) + 4}" text-anchor="end">${((high * k) / 2).toFixed(0)}</text>\n`;
  const line = points.map((p) => `${x(p.hours).toFixed(1)},${y(p.value).toFixed(1)}`).join(" ");
  return `${text}<polyline points="${line}" fill="none" stroke="#1668b8" stroke-width="1.5"/>\n`;
}

function picture(samples) {
  const hours = samples.at(-1).time / 3600;
  // As many points as can be told apart.
  const every = Math.max(1, Math.floor(samples.length / 560));
  const memory = samples.filter((_, k) => k % every === 0 || k === samples.length - 1)
    .map((s) => ({ hours: s.time / 3600, value: s.memory / 1e6 }));
  const cost = costs(samples, 48).map((c) => ({ hours: c.time / 3600, value: c.cost }));
  return `<svg xmlns="http://www.w3.org/2000/svg" width="640" height="440" font-family="sans-serif" font-size="11">
<rect width="640" height="440" fill="#fff"/>
${panel(30, "memory of the program [MB]", memory, hours)}${panel(240, "CPU for a simulated hour [s]", cost, hours)}</svg>\n`;
}

const samples = await measure();
writeFileSync(join(folder, "growth.csv"), "time_s,resident_bytes,cpu_s,state_records,unsent_bytes\n" +
  samples.map((s) => `${s.time},${s.memory},${s.cpu},${s.kept},${s.unsent}\n`).join(""));
writeFileSync(join(folder, "growth.svg"), picture(samples));
const cost = costs(samples, 48);
const [begin, middle, last] = [0, 1, 2].map((k) => third(samples, k));
const [, costMiddle, costLast] = [0, 1, 2].map((k) => third(cost, k));
for (const [name, part] of [["first", begin], ["second", middle], ["last", last]])
  console.log(`${name} third: memory at most ${(most(part, (s) => s.memory) / 1e6).toFixed(0)} MB, ` +
    `state ${most(part, (s) => s.kept)} records, unsent at most ${(most(part, (s) => s.unsent) / 1e6).toFixed(1)} MB`);
console.log(`CPU for a simulated hour: ${mean(costMiddle, (c) => c.cost).toFixed(1)} s in the second third, ` +
  `${mean(costLast, (c) => c.cost).toFixed(1)} s in the last; ${samples.at(-1).cpu.toFixed(0)} s in all`);
check(most(samples, (s) => s.memory) < kMaxMemory, "memory stays below 1 GB");
check(most(last, (s) => s.memory) < kMemoryRatio * most(middle, (s) => s.memory), "memory is bounded");
check(most(last, (s) => s.kept) < kKeptRatio * most(middle, (s) => s.kept), "what the server keeps is bounded");
check(mean(costLast, (c) => c.cost) < kCostRatio * mean(costMiddle, (c) => c.cost), "the run does not slow down");
