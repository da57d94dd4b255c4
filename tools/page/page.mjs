// SPDX-License-Identifier: Apache-2.0
// Drives the operator's page of a run, of two clients, of tokens and of a recorded run:
//   run page.mjs PROGRAM SCENARIO FOLDER      pictures go to the folder
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { check, openBrowser, serve, until } from "./program.mjs";

const [program, scenario, folder] = process.argv.slice(2);
if (!folder) throw new Error("usage: page.mjs PROGRAM SCENARIO FOLDER");
const browser = await openBrowser();
if (!browser) {
  console.log("skipped: no chromium");
  process.exit(77);
}
mkdirSync(folder, { recursive: true });
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const kTabs = ["fleet", "fire", "mission", "events", "plots", "links", "instructor"];
const faults = [];

async function open(place, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, ...options });
  const page = await context.newPage();
  page.on("pageerror", (error) => faults.push(error.message));
  await page.goto(place);
  return page;
}
const time = () => window.skein.world.time;
const complete = (page) => until(page, "the full state", () => Boolean(window.skein?.world.complete));
const newest = () => { const [sent] = window.skein.connection.sent; return { state: sent?.state, reason: sent?.reason }; };

async function steersARun() {
  const run = await serve(program, "run", scenario, "--serve", "0", "--speed", "4", "--overwrite", "--out", join(folder, "run"));
  const page = await open(run.place);
  await complete(page);
  await until(page, "four aircraft", () => window.skein.world.fleet.count, (count) => count === 4);
  await until(page, "rows of the fleet", () => document.querySelectorAll(".fleet-row").length, (count) => count === 4);
  check(true, "the fleet is listed");
  const before = await page.evaluate(time);
  await until(page, "simulated time", time, (now) => now > before + 2);

  await page.keyboard.press("Escape");
  await page.evaluate(() => window.skein.command({ kind: "pause", paused: true }, "pause"));
  await until(page, "pause", newest, ({ state }) => state === "accepted");
  await page.waitForTimeout(500);
  const stands = await page.evaluate(time);
  await page.waitForTimeout(700);
  check((await page.evaluate(time)) === stands, "time stands still while the run is paused");
  await page.evaluate(() => window.skein.command({ kind: "pause", paused: false }, "go on"));
  await until(page, "going on", time, (now) => now > stands + 1);

  await page.evaluate(() => window.skein.giveTask("scout-2", { kind: "survey", area: [[0, 0], [900, 0], [900, 900]], swath_m: 150 }));
  await until(page, "an accepted survey", newest, ({ state }) => state === "accepted");
  const task = await until(page, "the task", () => [...window.skein.world.tasks.values()].find(({ entity_id }) => entity_id === 2)?.what.kind,
    (kind) => kind === "survey");
  check(task === "survey", "a survey that is assigned becomes the aircraft's task");

  await page.evaluate(() => window.skein.command({ kind: "zone", in_force: true, name: "wood",
    area: { kind: "ring", points: [[300, 300], [300, 600], [600, 600], [600, 300]] } }, "zone"));
  await until(page, "the zone", () => [...window.skein.world.zones.keys()].includes("wood"));
  check(true, "a zone that is drawn comes into force");

  await page.evaluate(() => window.skein.command({ kind: "add", aircraft: "scout-9" }, "add"));
  const refused = await until(page, "a refusal", newest, ({ state }) => state === "refused");
  check(/scout-9/.test(refused.reason), `what cannot be done is refused with the reason: ${refused.reason}`);

  const other = await open(run.place);
  await complete(other);
  await other.evaluate(() => window.skein.command({ kind: "pause", paused: true }, "pause"));
  const denied = await until(other, "a refusal", newest, ({ state }) => state === "refused");
  check(/holds control/.test(denied.reason), "one client holds control");
  await other.context().close();

  await page.evaluate(() => window.skein.command({ kind: "fault", aircraft: "scout-1", part: "link", fails: true }, "fault"));
  await until(page, "the fault", newest, ({ state }) => state === "accepted");

  for (const scheme of ["light", "dark"]) {
    const shown = await open(run.place, { colorScheme: scheme, bypassCSP: true });
    await complete(shown);
    await shown.evaluate(axe);
    for (const tab of kTabs) {
      await shown.click(`#tab-${tab}`);
      await shown.waitForTimeout(600);
      await shown.screenshot({ path: join(folder, `${tab}-${scheme}.png`) });
      const { violations } = await shown.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
      check(violations.length === 0, `${tab} in ${scheme}: no violations of accessibility ${violations.map(({ id }) => id)}`);
    }
    await shown.context().close();
  }
  await run.stop();
  await until(page, "a lost connection", () => window.skein.connection.state, (state) => state !== "open");

  // The same port again, with another run.
  const again = await serve(program, "run", scenario, "--serve", new URL(run.place).port, "--speed", "4", "--overwrite",
    "--out", join(folder, "again"));
  await page.waitForFunction(() => window.skein?.world.complete && window.skein.world.time < 30, null, { timeout: 30000 });
  check(true, "the page is back after the server has restarted");
  await again.stop();
  await page.context().close();
}

// What an aircraft of a run expects to fly: no place of it lies in the zone.
const keepsOut = ([id, zone]) => {
  const path = window.skein.world.paths.get(id)?.points ?? [];
  return path.length > 1 && path.every(({ north_m, east_m }, i) => {
    const to = path[i + 1] ?? path[i];
    return Array.from({ length: 20 }, (_, k) => k / 20).every((share) =>
      Math.hypot(north_m + share * (to.north_m - north_m) - zone.north_m, east_m + share * (to.east_m - east_m) - zone.east_m) > zone.radius_m);
  });
};

/** Waits for `good(value, argument)`, where the value is read in the page with an argument. */
async function untilWith(page, what, read, argument, good = Boolean, patience = 60000) {
  const begin = Date.now();
  for (;;) {
    const value = await page.evaluate(read, argument);
    if (good(value)) return value;
    if (Date.now() - begin > patience) throw new Error(`${what}: still ${JSON.stringify(value)}`);
    await page.waitForTimeout(100);
  }
}

async function plansAhead() {
  const file = join(folder, "plain.yaml");
  writeFileSync(file, `name: plain
duration_s: 3600
environment: {terrain: flat, phenomena: [], wind: {kind: uniform, speed_mps: 4, from_deg: 300}}
missions: []
aircraft: [{name: scout, count: 2, start: {placement: line, centre_m: [0, 0], spacing_m: 300, heading_deg: 0}}]
`);
  const run = await serve(program, "run", file, "--serve", "0", "--speed", "4", "--overwrite", "--out", join(folder, "plain-run"));
  const page = await open(run.place);
  await complete(page);
  await until(page, "two aircraft", () => window.skein.world.fleet.count, (count) => count === 2);

  // Before a task is given: its form, what it would become, and only then the order.
  await page.evaluate(() => window.skein.map.select([1]));
  await page.getByRole("button", { name: "Give a task" }).click();
  const form = page.locator(".detail .task-form").first();
  await form.getByLabel("Task").selectOption("fly_to");
  await form.getByPlaceholder("north").fill("3000");
  await form.getByPlaceholder("east").fill("0");
  await form.getByRole("button", { name: "Fly ahead" }).click();
  const said = await until(page, "what a task would become", () => document.querySelector(".previews li")?.textContent ?? "",
    (text) => /done after/.test(text));
  check(/\d m|km/.test(said), `a task says what it takes before it is given: ${said}`);
  check(await page.evaluate(() => window.skein.world.tasks.get(1) === undefined), "nothing was given");
  await page.screenshot({ path: join(folder, "fly-ahead.png") });
  await form.getByRole("button", { name: "Send" }).click();
  await until(page, "the task", () => window.skein.world.tasks.get(1)?.what.kind, (kind) => kind === "fly_to");

  // A zone across the plan.
  const zone = { north_m: 1600, east_m: 60, radius_m: 250 };
  await untilWith(page, "a path through where the zone will be", keepsOut, [1, zone], (out) => !out);
  await page.evaluate(({ north_m, east_m, radius_m }) => window.skein.command({ kind: "zone", in_force: true, name: "wood",
    area: { kind: "disc", centre_north_m: north_m, centre_east_m: east_m, radius_m } }, "zone"), zone);
  await untilWith(page, "a path around the zone", keepsOut, [1, zone]);
  await page.waitForTimeout(1500);
  await page.screenshot({ path: join(folder, "re-plan.png") });
  check(true, "a zone that is drawn across a plan leads the plan around it");

  await page.getByRole("button", { name: "Height, speed" }).click();
  await page.getByLabel("Above ground").fill("200");
  await page.locator(".task-form:visible").getByRole("button", { name: "Send" }).click();
  await until(page, "another height", () => window.skein.world.fleet.get(window.skein.world.fleet.row(1), "altitude_msl_m"),
    (height) => height > 185);
  check(true, "an aircraft flies higher when it is told to");
  await page.context().close();
  await run.stop();
}

async function approvesAndTakesOver() {
  const file = join(folder, "team.yaml");
  writeFileSync(file, `name: team
duration_s: 3600
environment: {terrain: flat, phenomena: [], wind: {kind: uniform, speed_mps: 4, from_deg: 300}}
radio: {kind: ideal, loss: 0.2, delay_s: 0.2, jitter_s: 0.2}
stations: [{position_m: [-600, 0], team: {structure: master, approval: true}}]
aircraft: [{name: scout, count: 5, altitude_agl_m: 100, sensors: [gnss, air-data], start: {placement: line, centre_m: [-300, 0], spacing_m: 150}}]
missions:
  - kind: team
    name: valley
    tasks: [{task: "measure -300,-400 stay 2000"}, {task: "measure 300,0 stay 2000"}, {task: "measure 200,500 stay 2000"}]
`);
  const run = await serve(program, "run", file, "--serve", "0", "--speed", "8", "--overwrite", "--out", join(folder, "team-run"));
  const page = await open(run.place);
  await complete(page);
  await page.click("#tab-mission");
  const flown = () => {
    const all = [...window.skein.world.allocations.values()].filter(({ state }) => state === "approved" || state === "taken-over");
    return all.at(-1);
  };
  // A proposal is withdrawn when more of the team have been heard of: who has just approved it
  // is asked again about the next.
  const approve = page.getByRole("button", { name: "Approve", exact: true }).first();
  let approved;
  for (let tries = 0; approved?.state !== "approved"; ++tries) {
    if (tries === 8) throw new Error("no proposal was approved by its button");
    await approve.click({ timeout: 60000 });
    await page.waitForTimeout(2000);
    approved = await page.evaluate(flown);
  }
  check(approved.shares.length === 3, "a proposal is approved by its button");
  await until(page, "what members of the team do", () => Array.from({ length: window.skein.world.fleet.count }, (_, row) => window.skein.doing(row)).join(),
    (text) => /measures at a point/.test(text));
  await page.waitForTimeout(1000);
  await page.screenshot({ path: join(folder, "approved.png") });

  // One of those that fly a task fails: another takes it over without asking.
  const lost = approved.shares.find(({ entity_id }) => entity_id !== approved.proposer_id);
  await page.evaluate((id) => window.skein.command({ kind: "fault", aircraft: window.skein.world.name(id), part: "link", fails: true }, "fault"),
    lost.entity_id);
  const after = await until(page, "a takeover", flown, (each) => each?.state === "taken-over", 90000);
  check(after.shares.some(({ entity_id, task }) => task === lost.task && entity_id !== lost.entity_id),
    "another aircraft goes on with the task of one that fails");

  // A task of the team is changed by the form, and withdrawn by its button.
  const tasks = () => [...window.skein.world.teamTasks.values()].map(({ number, state }) => `${number} ${state}`).join();
  await page.click("#tab-fleet");
  await page.evaluate(() => window.skein.map.select([5]));
  await page.getByRole("button", { name: "Give a task" }).click();
  const form = page.locator(".task-form:visible");
  await form.getByLabel("Who flies it").selectOption({ label: "the team, in place of task 2 (Measure at a point)" });
  await form.getByLabel("Task", { exact: true }).selectOption("measure");
  await form.getByPlaceholder("north").fill("400");
  await form.getByPlaceholder("east").fill("100");
  await form.getByRole("button", { name: "Send" }).click();
  await until(page, "another task in the place of one", tasks, (text) => text.includes("2 withdrawn") && text.includes("4 "));
  await page.click("#tab-mission");
  await page.locator("li.card", { hasText: "1: Measure at a point" }).getByRole("button", { name: "Withdraw", exact: true }).click();
  await until(page, "a task that is withdrawn", tasks, (text) => text.includes("1 withdrawn"));
  check(true, "tasks of a team are changed and withdrawn");
  await page.screenshot({ path: join(folder, "team-tasks.png") });
  await page.context().close();
  await run.stop();
}

async function asksForATokens() {
  const tokens = join(folder, "tokens");
  writeFileSync(tokens, "viewer-viewer-viewer viewer Vera\noperator-operator-1 operator Anna\n", { mode: 0o600 });
  const run = await serve(program, "run", scenario, "--serve", "0", "--tokens", tokens, "--overwrite", "--out", join(folder, "tokens-run"));
  const page = await open(run.place);
  const field = page.locator("input[type=password]");
  await field.waitFor();
  await field.fill("wrong-wrong-wrong-wrong");
  await page.keyboard.press("Enter");
  await page.waitForTimeout(700);
  check(await field.isVisible(), "a wrong token is refused");
  await field.fill("viewer-viewer-viewer");
  await page.keyboard.press("Enter");
  await complete(page);
  check(!page.url().includes("viewer-viewer"), "the token is in no address");
  await page.evaluate(() => window.skein.command({ kind: "pause", paused: true }, "pause"));
  const { reason } = await until(page, "a refusal", newest, ({ state }) => state === "refused");
  check(/viewers only see|control|may/.test(reason), `viewers give no commands: ${reason}`);
  await page.context().close();
  await run.stop();
}

async function showsARecordedRun() {
  const run = await serve(program, "replay", join(folder, "run"), "--serve", "0");
  const page = await open(run.place);
  await complete(page);
  await page.evaluate(() => window.skein.seek(10));
  await until(page, "another time", time, (now) => now >= 10 && now < 20);
  await page.screenshot({ path: join(folder, "replay.png") });
  check(true, "a recorded run is shown at any time");
  await page.context().close();
  await run.stop();
}

try {
  await steersARun();
  await plansAhead();
  await approvesAndTakesOver();
  await asksForATokens();
  await showsARecordedRun();
  check(faults.length === 0, `no errors in the pages ${faults}`);
} finally {
  await browser.close();
}
