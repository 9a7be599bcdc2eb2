// SPDX-License-Identifier: Apache-2.0
// Makes results and uses their pages as people do.
//
//   node run.mjs CASE MYOTET CHROMIUM SHARED_FOLDER FOLDER
//
// Ends with 77 when what the case needs is not there.
import { execFileSync } from "node:child_process";
import { mkdirSync, rmSync } from "node:fs";
import { launch } from "./opened.mjs";

const [name, myotet, chromium, shared, folder] = process.argv.slice(2);
const { make, use } = await import(`./${name}.mjs`);

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
const run = (...words) => execFileSync(myotet, words, { cwd: folder, stdio: ["ignore", "ignore", "inherit"] });
const missing = make({ run, folder, shared });
if (missing) {
  console.log(`skipped: ${missing}`);
  process.exit(77);
}
const browser = await launch(chromium);
try {
  await use({ browser, folder, run });
} finally {
  await browser.close();
}
