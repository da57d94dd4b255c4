// Bundles a page's folder (main.ts and the style sheet it imports) and writes script and
// style as C++ text, functions page_script() and page_style() of skein::NAMESPACE that the
// header NAMESPACE/page_assets.h declares: build.mjs FOLDER NAMESPACE OUTPUT.cpp
import { writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

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
#include "skein/${namespace}/page_assets.h"

namespace skein::${namespace} {

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

}  // namespace skein::${namespace}
`,
);
