// SPDX-License-Identifier: Apache-2.0
// Bundles a page's folder (main.ts and the style sheet it imports) and writes script and
// style as C++ text, functions page_script() and page_style() of skein::NAMESPACE that the
// header skein/NAMESPACE/FOLDER/page_assets.h declares: build.mjs FOLDER NAMESPACE OUTPUT.cpp
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { textFunction } from "./cpp_text.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const [folder, namespace, output] = process.argv.slice(2);
if (!output) throw new Error("usage: node build.mjs FOLDER NAMESPACE OUTPUT.cpp");

const result = await build({
  entryPoints: [join(here, folder, "main.ts")],
  bundle: true,
  minify: true,
  format: "iife",
  target: ["chrome90", "firefox90", "safari15"],
  legalComments: "inline",
  outdir: here,
  write: false,
});
const content = (extension) => result.outputFiles.find((file) => file.path.endsWith(extension)).text;

writeFileSync(
  output,
  `// Made by web/build.mjs.
#include "skein/${namespace}/${folder}/page_assets.h"

namespace skein::${namespace} {

${textFunction("page_script", content(".js"))}
${textFunction("page_style", content(".css"))}
}  // namespace skein::${namespace}
`,
);
