// SPDX-License-Identifier: Apache-2.0
// Bundles the operator's page: build_live.mjs FOLDER writes index.html, page.js, page.css and
// worker.js into it. All of the page is in these four files; it asks nobody else for anything.
// licenses.txt has the notices of the libraries in them.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const [folder, ...flags] = process.argv.slice(2);
if (!folder) throw new Error("usage: node build_live.mjs FOLDER [--size]");
mkdirSync(folder, { recursive: true });

await build({
  entryPoints: { page: join(here, "live/main.ts"), worker: join(here, "node_modules/maplibre-gl/dist/maplibre-gl-worker.mjs") },
  bundle: true,
  minify: true,
  format: "esm",
  target: ["es2022"],
  legalComments: "none",
  outdir: folder,
});
const index = readFileSync(join(here, "live/index.html"), "utf8");
writeFileSync(join(folder, "index.html"), index);

const notices = ["maplibre-gl", "terra-draw", "terra-draw-maplibre-gl-adapter", "uplot"].map((name) => {
  const at = join(here, "node_modules", name);
  const { version, license } = JSON.parse(readFileSync(join(at, "package.json"), "utf8"));
  const file = ["LICENSE", "LICENSE.txt", "LICENSE.md"].map((each) => join(at, each)).find(existsSync);
  return `${name} ${version} (${license})\n\n${file ? readFileSync(file, "utf8").trim() : ""}\n`;
});
writeFileSync(join(folder, "licenses.txt"), notices.join("\n\n"));

if (flags.includes("--size")) {
  let sum = 0;
  for (const name of ["index.html", "page.js", "page.css", "worker.js"]) {
    const size = gzipSync(readFileSync(join(folder, name)), { level: 9 }).length;
    sum += size;
    console.log(`${name}: ${(size / 1000).toFixed(1)} kB`);
  }
  console.log(`all, gzip: ${(sum / 1000).toFixed(1)} kB`);
}
