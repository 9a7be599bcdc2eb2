// SPDX-License-Identifier: Apache-2.0
// Makes the viewer's program one script, packs it and writes it down as C++.
//
//   node build.mjs ViewerProgram.cpp    in a folder with the packages of package-lock.json
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { deflateSync } from "node:zlib";
import { build } from "esbuild";

const mostBytes = 1.5e6;

/** The text of a package's licence: its file, else that part of its README. */
function licenceOf(folder, license) {
  const files = readdirSync(folder).sort();
  const file = files.find((name) => /^licen[cs]e/i.test(name));
  const whole = file ? readFileSync(join(folder, file), "utf8").trim() : "";
  // This licence asks for nothing; whose the package is is told all the same.
  if (/WTFPL/.test(license)) return whole.match(/^.*copyright.*$/im)[0].trim();
  if (file) return whole;
  const readme = files.find((name) => /^readme/i.test(name));
  const text = readme ? readFileSync(join(folder, readme), "utf8") : "";
  const at = text.search(/^#*\s*licen[cs]e\b.*$/im);
  if (at < 0) throw new Error(`${folder} has no licence text`);
  return text.slice(at).trim();
}

/** Name, version, licence and its text of each package of which something is in the script. */
function notices(metafile) {
  const folders = new Set();
  for (const output of Object.values(metafile.outputs))
    for (const [path, { bytesInOutput }] of Object.entries(output.inputs)) {
      const found = path.match(/^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//);
      if (found && bytesInOutput > 0) folders.add(found[1]);
    }
  return [...folders]
    .sort()
    .map((folder) => {
      const { name, version, license } = JSON.parse(
        readFileSync(join(folder, "package.json"), "utf8"),
      );
      return `${name} ${version}, ${license}\n\n${licenceOf(folder, license)}\n`;
    })
    .join("\n----\n\n");
}

/** A text as literals of C++, which compilers want in pieces. */
function literal(text) {
  const pieces = text.match(/[^]{1,8000}/g) ?? [""];
  return pieces.map((piece) => `    R"viewer(${piece})viewer"`).join("\n");
}

const result = await build({
  entryPoints: ["src/viewer.ts"],
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2022",
  loader: { ".css": "text" },
  legalComments: "eof",
  metafile: true,
  write: false,
});
const script = result.outputFiles[0].contents;
if (script.length > mostBytes)
  throw new Error(`the script has ${script.length} bytes; ${mostBytes} are allowed`);
const packed = deflateSync(script, { level: 9 }).toString("base64");
writeFileSync(
  process.argv[2],
  `// Made by build.mjs.
#include "Report/ViewerProgram.h"

namespace myotet::report {

const std::string_view kViewerProgram =
${literal(packed)};

const std::string_view kViewerNotices =
${literal(notices(result.metafile))};

}  // namespace myotet::report
`,
);
console.log(`viewer: ${script.length} bytes, ${packed.length} packed`);
