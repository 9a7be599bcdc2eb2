// SPDX-License-Identifier: Apache-2.0
// Bones, ligaments and menisci of a knee.
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { numbersOf, openPage, picture, viewOpens } from "./opened.mjs";
import { covered, difference } from "./picture.mjs";

export function make({ run, shared }) {
  const scan = join(shared, "data/labels/spl_knee/spl_knee_seg_sub3_MODIFIED.nii.gz");
  if (!existsSync(scan)) return `${scan} is not there`;
  run("mesh", scan, "-o", "out", "--names", join(shared, "data/labels/spl_knee/knee.ctbl"),
    "--labels", "95,96,97,98,31,32,35,81,82", "--edge-length", "6", "--quality", "draft", "--quiet");
}

export async function use({ browser, folder }) {
  const { page, wrong, close } = await openPage(browser, join(folder, "out/report.html"));
  const report = JSON.parse(readFileSync(join(folder, "out/report.json"), "utf8"));
  await viewOpens(page);
  console.log(`the view of ${report.tissues.length} tissues opened in ` +
    `${await page.locator("#viewer").getAttribute("data-milliseconds")} ms`);
  const whole = await picture(page);
  assert.ok(covered(whole) > 0.1, "the picture is blank");
  const numbers = await numbersOf(page);
  for (const tissue of report.tissues)
    for (const key of ["voxels", "tets", "volume_labels_mm3", "volume_mesh_mm3"])
      assert.ok(numbers.has(tissue[key]), `${tissue.name} ${key}`);
  const names = await page.locator("#viewer .bodies label").allInnerTexts();
  assert.equal(names.length, report.tissues.length);
  const femur = page.locator("#viewer .bodies li", { hasText: "femur" }).first();
  await femur.locator("input[type=checkbox]").uncheck();
  assert.ok(difference(whole, await picture(page)) > 0.005, "without the femur");
  assert.deepEqual(wrong, []);
  await close();
}
