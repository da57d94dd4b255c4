// Bundles the report page and writes it as C++ text: build.mjs OUTPUT.cpp
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const output = process.argv[2];
if (!output) throw new Error("usage: node build.mjs OUTPUT.cpp");

const result = await build({
  entryPoints: [join(here, "report/main.ts")],
  bundle: true,
  minify: true,
  format: "iife",
  target: ["chrome90", "firefox90", "safari15"],
  legalComments: "inline",
  outdir: here,
  write: false,
});

// String literals end at 64 kB in some compilers: pieces are joined by the compiler.
function literal(text) {
  const pieces = [];
  for (let i = 0; i < text.length; i += 8000)
    pieces.push(`R"skein_(${text.slice(i, i + 8000)})skein_"`);
  return pieces.join("\n    ");
}

function content(extension) {
  const text = result.outputFiles.find((file) => file.path.endsWith(extension)).text;
  if (text.includes(')skein_"')) throw new Error("the bundle contains the literal's end");
  return text;
}

writeFileSync(
  output,
  `// Made by web/build.mjs.
#include "record/page_assets.h"

namespace skein::record {

std::string_view page_script() {
  static constexpr std::string_view text =
    ${literal(content(".js"))};
  return text;
}

std::string_view page_style() {
  static constexpr std::string_view text =
    ${literal(content(".css"))};
  return text;
}

}  // namespace skein::record
`,
);
