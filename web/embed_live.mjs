// SPDX-License-Identifier: Apache-2.0
// Turns the operator's page, as build_live.mjs made it, into C++ text: its files compressed,
// in the table that skein/layer/hmi/serve/page_files.h declares. embed_live.mjs FOLDER OUTPUT.cpp
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

const kFiles = [
  ["/", "index.html", "text/html; charset=utf-8"],
  ["/page.js", "page.js", "text/javascript; charset=utf-8"],
  ["/worker.js", "worker.js", "text/javascript; charset=utf-8"],
  ["/page.css", "page.css", "text/css; charset=utf-8"],
  ["/licenses.txt", "licenses.txt", "text/plain; charset=utf-8"],
];

const [folder, output] = process.argv.slice(2);
if (!output) throw new Error("usage: node embed_live.mjs FOLDER OUTPUT.cpp");

// Every byte by its number: three octal digits, so that none runs into the next.
function literal(bytes) {
  const lines = [];
  for (let i = 0; i < bytes.length; i += 4000)
    lines.push(`"${Array.from(bytes.subarray(i, i + 4000), (b) => "\\" + b.toString(8).padStart(3, "0")).join("")}"`);
  return lines.join("\n    ");
}

const assets = kFiles.map(([path, name, type]) => {
  const bytes = gzipSync(readFileSync(join(folder, name)), { level: 9 });
  return `    {"${path}", "${type}", {\n    ${literal(bytes)}, ${bytes.length}}},`;
});

writeFileSync(
  output,
  `// Made by web/embed_live.mjs.
#include "skein/layer/hmi/serve/page_files.h"

namespace skein::hmi {

std::span<const PageAsset> page_assets() {
  static constexpr PageAsset kAssets[] = {
${assets.join("\n")}
  };
  return kAssets;
}

}  // namespace skein::hmi
`,
);
