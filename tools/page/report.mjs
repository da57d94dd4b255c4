// SPDX-License-Identifier: Apache-2.0
// Drives the report of a run, and that of two runs side by side, opened as files:
//   run report.mjs PROGRAM SCENARIO FOLDER      pictures go to the folder
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { check, openBrowser, until } from "./program.mjs";

const [program, scenario, folder] = process.argv.slice(2);
if (!folder) throw new Error("usage: report.mjs PROGRAM SCENARIO FOLDER");
const browser = await openBrowser();
if (!browser) {
  console.log("skipped: no chromium");
  process.exit(77);
}
mkdirSync(folder, { recursive: true });
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const kSchemes = ["light", "dark"];
const kDuration = 900; // of each run [s]
const problems = [];

function skein(...args) {
  execFileSync(program, args, { stdio: ["ignore", "ignore", "inherit"] });
}

function run(name, ...more) {
  const out = join(folder, name);
  skein("run", scenario, "--set", `duration_s=${kDuration}`, ...more, "--overwrite", "--out", out);
  return out;
}

function report(name, ...runs) {
  const file = join(folder, `${name}.html`);
  skein("report", ...runs, "--out", file);
  return pathToFileURL(resolve(file)).href;
}

async function open(place, colorScheme) {
  const context = await browser.newContext({ viewport: { width: 1380, height: 1000 }, colorScheme, bypassCSP: true });
  const page = await context.newPage();
  page.on("pageerror", (error) => problems.push(error.message));
  page.on("console", (message) => { if (message.type() === "error") problems.push(message.text()); });
  page.on("request", (request) => { if (!/^(blob|data):/.test(request.url()) && request.url() !== place) problems.push(`asked for ${request.url()}`); });
  await page.goto(place);
  await until(page, "the page", () => document.documentElement.dataset.state, (state) => state === "ready");
  return page;
}

const seconds = () => document.querySelector(".run-time").textContent.split(":").reduce((sum, part) => 60 * sum + Number(part), 0);
// How many pixels of each map's drawing, which is above the ground, have any colour.
const drawn = () => [...document.querySelectorAll("canvas.field")].map((canvas) =>
  canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.reduce((sum, value, i) => sum + (i % 4 === 3 && value > 0 ? 1 : 0), 0));
const isDrawn = (count) => (pixels) => pixels.length === count && pixels.every((each) => each > 1000);

async function look(page, name) {
  await page.locator("#map").scrollIntoViewIfNeeded();
  await page.waitForTimeout(1500); // the ground comes a little later
  await page.locator("#map").screenshot({ path: join(folder, `${name}.png`) });
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  check(violations.length === 0, `${name}: no violations of accessibility ${violations.map(({ id }) => id)}`);
}

async function movesThroughTime(page) {
  const slider = page.locator("input.seek"), play = page.locator(".time-controls button").first();
  check((await slider.count()) === 1, "one slider moves through the time");
  await slider.fill("300");
  await until(page, "another time", seconds, (time) => time === 300);
  check(true, "the slider goes to a time");
  await page.getByRole("button", { name: "Next event" }).click();
  const event = await until(page, "an event", seconds, (time) => time > 300);
  await page.getByRole("button", { name: "Previous event" }).click();
  await until(page, "the event before", seconds, (time) => time < event);
  check(true, "buttons go from event to event");
  await slider.fill("100");
  await play.click();
  await until(page, "playing", seconds, (time) => time > 110);
  await play.click();
  await page.waitForTimeout(500);
  const stands = await page.evaluate(seconds);
  await page.waitForTimeout(700);
  check((await page.evaluate(seconds)) === stands, "it plays, and stands still");
}

async function showsARun(place) {
  for (const scheme of kSchemes) {
    const page = await open(place, scheme);
    await until(page, "what is known of the fire", drawn, isDrawn(1));
    await look(page, `report-${scheme}`);
    if (scheme === "light") {
      await movesThroughTime(page);
      await page.locator(".map-frame .maplibregl-canvas").focus();
      for (const [what, state] of [["the third dimension", "true"], ["two dimensions", "false"]]) {
        await page.keyboard.press("d");
        await until(page, what, () => document.querySelector(".dimension").getAttribute("aria-pressed"), (on) => on === state);
      }
      check(true, "keys turn the map into three dimensions and back");
      const pictures = await page.evaluate(() => {
        window.dispatchEvent(new Event("beforeprint"));
        const count = document.querySelectorAll(".print-maps canvas").length;
        window.dispatchEvent(new Event("afterprint"));
        return [count, document.querySelectorAll(".print-maps canvas").length];
      });
      check(pictures.join() === "4,0", `four pictures are printed ${pictures}`);
    }
    await page.context().close();
  }
}

async function comparesTwoRuns(place) {
  for (const scheme of kSchemes) {
    const page = await open(place, scheme);
    await until(page, "both fires", drawn, isDrawn(2));
    await look(page, `comparison-${scheme}`);
    if (scheme === "light") {
      await movesThroughTime(page);
      const choice = page.locator(".map-frame select[aria-label='Run on the map']").nth(1);
      await choice.selectOption("0");
      await until(page, "the same run twice", drawn, isDrawn(2));
      await until(page, "the same figures", () => new Set([...document.querySelectorAll(".map-frame .status")].map((each) => each.textContent)).size, (count) => count === 1);
      check(true, "each frame shows the run that is chosen");
    }
    await page.context().close();
  }
}

try {
  const one = run("one"), two = run("two", "--seed", "2");
  await showsARun(report("report", one));
  await comparesTwoRuns(report("comparison", one, two));
  check(problems.length === 0, `no errors, nothing is asked for ${problems.join("; ")}`);
} finally {
  await browser.close();
}
