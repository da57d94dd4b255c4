// SPDX-License-Identifier: Apache-2.0
// Measures the server and the page on a run:
//   run measure.mjs PROGRAM SCENARIO FOLDER MINUTES [OPTION OF RUN...]
// CPU of the program without clients and with ten, what a client is sent, the first
// picture, script per frame and frames, and the page's memory over MINUTES.
import { existsSync, mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { openBrowser, serve, until } from "./program.mjs";

const { WebSocket } = createRequire(import.meta.url)("ws");
const [program, scenario, folder, minutes, ...options] = process.argv.slice(2);
if (!minutes) throw new Error("usage: measure.mjs PROGRAM SCENARIO FOLDER MINUTES [OPTION...]");
mkdirSync(folder, { recursive: true });
const kClients = 10, kSample = 30; // [s]
const sleep = (seconds) => new Promise((resolve) => setTimeout(resolve, 1000 * seconds));
const median = (all) => [...all].sort((a, b) => a - b)[Math.floor(all.length / 2)];
const say = (what, value) => console.log(`${what}: ${value}`);

/** CPU seconds that a process has used. */
function cpu(pid) {
  const [, fields] = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ");
  const [utime, stime] = fields.split(" ").slice(11, 13).map(Number);
  return (utime + stime) / 100;
}

async function sample(pid, seconds) {
  const before = cpu(pid), begin = Date.now();
  await sleep(seconds);
  return (cpu(pid) - before) / ((Date.now() - begin) / 1000);
}

const run = await serve(program, "run", scenario, "--serve", "0", "--overwrite", "--out", join(folder, "measured"), ...options);
try {
  const health = async () => (await fetch(new URL("api/health", run.place))).json();
  await sleep(10);
  const alone = await sample(run.pid, kSample);
  let bytes = 0;
  const clients = Array.from({ length: kClients }, () => {
    const socket = new WebSocket(new URL("live", run.place.replace("http", "ws")), ["skein.live.v1"]);
    socket.on("message", (data) => { bytes += data.length; });
    return socket;
  });
  await sleep(3);
  bytes = 0;
  const watched = await sample(run.pid, kSample);
  say("CPU without clients [cores]", alone.toFixed(3));
  say(`CPU with ${kClients} clients [cores]`, watched.toFixed(3));
  say("of them for the clients [cores]", (watched - alone).toFixed(3));
  say("each client is sent [kB/s]", (bytes / kClients / kSample / 1000).toFixed(0));
  for (const client of clients) client.close();
  const { speed, misses } = await health();
  say("speed of the run, missed deadlines", `${speed.toFixed(2)}, ${misses}`);

  const sizes = {};
  for (const name of ["", "page.js", "worker.js", "page.css"]) {
    const body = Buffer.from(await (await fetch(new URL(name, run.place))).arrayBuffer());
    sizes[name || "index"] = gzipSync(body, { level: 9 }).length;
  }
  say("page, compressed [kB]", (Object.values(sizes).reduce((a, b) => a + b) / 1000).toFixed(0));

  const browser = await openBrowser();
  if (!browser) throw new Error("no chromium");
  try {
    const page = await (await browser.newContext({ viewport: { width: 1280, height: 800 } })).newPage();
    await page.goto(run.place);
    await until(page, "the first picture", () => performance.getEntriesByName("first picture")[0]?.startTime, Boolean, 60000);
    say("first picture after [s]", (await page.evaluate(() => performance.getEntriesByName("first picture")[0].startTime / 1000)).toFixed(2));
    await sleep(10);
    const begin = await page.evaluate(() => ({ frames: window.skein.map.frames, at: performance.now() }));
    await sleep(kSample);
    const end = await page.evaluate(() => ({ frames: window.skein.map.frames, at: performance.now(), times: [...window.skein.map.frameTimes] }));
    say("frames drawn [1/s]", ((1000 * (end.frames - begin.frames)) / (end.at - begin.at)).toFixed(1));
    const times = end.times.filter((time) => time > 0);
    say("script per frame, median and 95 % [ms]", `${median(times).toFixed(2)}, ${[...times].sort((a, b) => a - b)[Math.floor(0.95 * times.length)].toFixed(2)}`);
    const session = await page.context().newCDPSession(page);
    const heap = async () => {
      await session.send("HeapProfiler.collectGarbage");
      return (await session.send("Runtime.getHeapUsage")).usedSize / 1e6;
    };
    const heaps = [];
    for (let k = 0; k <= Number(minutes); ++k) {
      heaps.push(await heap());
      console.log(`heap after ${k} min [MB]: ${heaps.at(-1).toFixed(1)}`);
      if (k < Number(minutes)) await sleep(60);
    }
  } finally {
    await browser.close();
  }
} finally {
  await run.stop();
}
if (existsSync(join(folder, "measured"))) say("records are in", join(folder, "measured"));
