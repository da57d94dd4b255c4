// SPDX-License-Identifier: Apache-2.0
// Skein's program and a browser, for tests of the operator's page.
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { chromium } from "playwright-core";

/** Runs the program until its page can be had; `place` is its address. */
export async function serve(program, ...args) {
  const child = spawn(program, args, { stdio: ["ignore", "ignore", "pipe"] });
  process.on("exit", () => child.kill("SIGKILL"));  // a test that fails leaves nobody in its folder
  let said = "";
  const place = await new Promise((resolve, reject) => {
    child.stderr.on("data", (data) => {
      said += data;
      const found = /The page: (\S+)/.exec(said);
      if (found) resolve(found[1]);
    });
    child.on("exit", (status) => reject(new Error(`the program ended (${status}): ${said}`)));
  });
  const ended = new Promise((resolve) => child.on("exit", resolve));
  return { place, pid: child.pid, said: () => said, stop: async () => { child.kill("SIGINT"); await ended; } };
}

const kBrowsers = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];

/** A browser without a screen; null: this machine has none. */
export async function openBrowser() {
  const executablePath = kBrowsers.find(existsSync);
  if (!executablePath) return null;
  return chromium.launch({ executablePath,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"] });
}

/** Waits until `good(value)`, where the value comes from the page; returns it. */
export async function until(page, what, read, good = Boolean, patience = 30000) {
  const begin = Date.now();
  for (;;) {
    const value = await page.evaluate(read);
    if (good(value)) return value;
    if (Date.now() - begin > patience) throw new Error(`${what}: still ${JSON.stringify(value)}`);
    await page.waitForTimeout(100);
  }
}

export function check(condition, what) {
  if (!condition) throw new Error(what);
  console.log(`ok: ${what}`);
}
