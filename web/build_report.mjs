// SPDX-License-Identifier: Apache-2.0
// Bundles the pages of reports (web/report) and writes them as C++ text, the functions of
// skein/record/report/page_assets.h: build_report.mjs OUTPUT.cpp [--size]
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { deflateSync } from "node:zlib";
import { build } from "esbuild";
import { textFunction } from "./cpp_text.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const [output, ...flags] = process.argv.slice(2);
if (!output) throw new Error("usage: node build_report.mjs OUTPUT.cpp [--size]");

async function bundle(entry, extension = ".js") {
  const { outputFiles } = await build({
    entryPoints: [join(here, entry)],
    bundle: true,
    minify: true,
    format: "iife",
    target: ["es2022"],
    legalComments: "inline",
    outdir: here,
    write: false,
  });
  return outputFiles.find((file) => file.path.endsWith(extension)).text;
}

const packed = (text) => deflateSync(text, { level: 9 }).toString("base64");
const parts = {
  runs_script: packed(await bundle("report/main.ts")),
  map_worker: packed(await bundle("node_modules/maplibre-gl/dist/maplibre-gl-worker.mjs")),
  study_script: packed(await bundle("report/study.ts")),
  loader_script: await bundle("report/loader.ts"),
  page_style: await bundle("report/main.ts", ".css"),
};
if (flags.includes("--size")) for (const [name, text] of Object.entries(parts)) console.log(`${name}: ${(text.length / 1000).toFixed(1)} kB`);

writeFileSync(
  output,
  `// Made by web/build_report.mjs.
#include "skein/record/report/page_assets.h"

namespace skein::record {

${Object.entries(parts)
  .map(([name, text]) => textFunction(name, text))
  .join("\n")}
}  // namespace skein::record
`,
);
