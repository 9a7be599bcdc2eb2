// SPDX-License-Identifier: Apache-2.0
// The arm phantom's meshes: the view does what its controls say.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { numbersOf, openPage, picture, viewOpens } from "./opened.mjs";
import { covered, difference } from "./picture.mjs";

const evil = '<img/src=x/onerror=document.title=1>';

export function make({ run, folder }) {
  run("phantom", "arm", "-o", "arm.nii.gz", "--spacing", "2", "2", "2");
  writeFileSync(join(folder, "names.txt"), `1 ${evil}\n2 radius_ulna\n10 biceps\n`);
  run("mesh", "arm.nii.gz", "-o", "out", "--names", "names.txt", "--edge-length", "7",
    "--quality", "draft", "--quiet");
}

export async function use({ browser, folder }) {
  const { page, wrong, close } = await openPage(browser, join(folder, "out/report.html"));
  const report = JSON.parse(readFileSync(join(folder, "out/report.json"), "utf8"));
  await viewOpens(page);
  const whole = await picture(page);
  assert.ok(covered(whole) > 0.05, "the picture is blank");

  await tablesHold(page, report);
  await namesAreTexts(page, report);
  await switchesChange(page, whole);
  await looksChange(page);
  await keysChange(page);
  await coloursTellTheTruth(page, report);
  await cutShowsInside(page);
  assert.deepEqual(wrong, []);
  await close();
  await darkAndNarrow(browser, join(folder, "out/report.html"));
  await printed(browser, join(folder, "out/report.html"));
}

async function tablesHold(page, report) {
  const numbers = await numbersOf(page);
  for (const tissue of report.tissues)
    for (const key of ["voxels", "tets", "vertices", "volume_mesh_mm3", "min_dihedral_deg",
      "max_aspect_ratio", "surface_distance_max_mm"])
      assert.ok(numbers.has(tissue[key]), `${tissue.name} ${key} ${tissue[key]}`);
}

async function namesAreTexts(page, report) {
  const names = await page.locator("#viewer .bodies label").allInnerTexts();
  assert.equal(names.length, report.tissues.length);
  assert.equal(names[0].trim(), `1 ${evil}`);
  assert.equal(await page.locator('img[src="x"]').count(), 0);
  assert.notEqual(await page.title(), "1");
}

const lettersCover = 0.004; // of the picture: the sides are told in it
const row = (page, i) => page.locator("#viewer .bodies li").nth(i);

async function switchesChange(page, whole) {
  const box = row(page, 0).locator("input[type=checkbox]");
  await box.uncheck();
  const without = await picture(page);
  assert.ok(difference(whole, without) > 0.005, "a tissue that is off still shows");
  await box.check();
  assert.ok(difference(whole, await picture(page)) < 0.001, "on again is not as before");

  await row(page, 1).getByRole("button").click();
  const alone = await picture(page);
  assert.ok(covered(alone) > lettersCover && covered(alone) < covered(whole), "isolated");
  assert.equal(await page.locator("#viewer .bodies input:checked").count(), 1);
  await page.getByRole("button", { name: "show none" }).click();
  assert.ok(covered(await picture(page)) < lettersCover, "none shows something");
  await page.getByRole("button", { name: "show all" }).click();

  await page.getByLabel("opacity of all").fill("0.3");
  assert.ok(difference(whole, await picture(page)) > 0.03, "transparency");
  await page.getByLabel("opacity of all").fill("1");
  await page.getByLabel("edges of the mesh").check();
  assert.ok(difference(whole, await picture(page)) > 0.02, "edges");
  await page.getByLabel("edges of the mesh").uncheck();
}

async function looksChange(page) {
  const letters = () =>
    Promise.all(
      ["left", "right", "top", "bottom"].map((place) =>
        page.locator(`#viewer .side.${place}`).textContent(),
      ),
    );
  const expected = {
    front: ["R", "L", "S", "I"],
    back: ["L", "R", "S", "I"],
    left: ["A", "P", "S", "I"],
    right: ["P", "A", "S", "I"],
    above: ["L", "R", "A", "P"],
    below: ["R", "L", "A", "P"],
  };
  for (const [name, sides] of Object.entries(expected)) {
    await page.getByRole("button", { name: `from ${name}` }).click();
    await picture(page);
    assert.deepEqual(await letters(), sides, name);
  }
  await page.getByRole("button", { name: "from front" }).click();
}

async function keysChange(page) {
  const before = await picture(page);
  await page.locator("#viewer canvas").focus();
  for (const key of ["ArrowLeft", "Shift+ArrowUp", "+"]) {
    const last = await picture(page);
    await page.keyboard.press(key);
    assert.ok(difference(last, await picture(page)) > 0.002, key);
  }
  await page.keyboard.press("0");
  assert.ok(difference(before, await picture(page)) < 0.02, "0 goes back to the front");
  const canvas = await page.locator("#viewer canvas").boundingBox();
  await page.mouse.move(canvas.x + 200, canvas.y + 200);
  await page.mouse.down();
  await page.mouse.move(canvas.x + 300, canvas.y + 240, { steps: 3 });
  await page.mouse.up();
  assert.ok(difference(before, await picture(page)) > 0.01, "dragging turns");
  await page.getByRole("button", { name: "from front" }).click();
}

// Limits of the colours come from the unpacked mesh, those of report.json from the mesh itself.
async function coloursTellTheTruth(page, report) {
  const plain = await picture(page);
  const limits = async (name) => {
    await page.getByLabel("colour by").selectOption({ label: name });
    assert.ok(difference(plain, await picture(page)) > 0.02, name);
    return (await page.locator("#viewer .ends span").allTextContents()).map(Number);
  };
  const extreme = (key, of) => of(...report.tissues.map((tissue) => tissue[key]));
  const near = (found, wanted, part) =>
    assert.ok(Math.abs(found - wanted) <= part * wanted, `${found}, not ${wanted}`);
  const rounding = 2e-3; // coordinates to 1/65535 of a tissue's box, four digits of a limit
  near((await limits("smallest dihedral angle, degrees"))[0], extreme("min_dihedral_deg", Math.min), 5 * rounding);
  near((await limits("largest dihedral angle, degrees"))[1], extreme("max_dihedral_deg", Math.max), rounding);
  near((await limits("aspect ratio"))[1], extreme("max_aspect_ratio", Math.max), 5 * rounding);
  const far = await limits("distance to the labels, mm");
  assert.ok(far[0] === 0 && far[1] > 0.2 && far[1] < 6, `${far}`);
  await page.getByLabel("colour by").selectOption({ index: 0 });
}

async function cutShowsInside(page) {
  const whole = await picture(page);
  await page.getByLabel("cut", { exact: true }).selectOption({ label: "front to back" });
  const cut = await picture(page);
  assert.ok(difference(whole, cut) > 0.05, "a cut from the front");
  assert.ok(covered(cut) > 0.7 * covered(whole), "what lies behind the cut stays");
  await page.getByLabel("where the cut is").fill("0.7");
  assert.ok(difference(cut, await picture(page)) > 0.02, "the cut moves");
  await page.getByLabel("the other side").check();
  assert.ok(difference(cut, await picture(page)) > 0.02, "the other side");
  await page.getByLabel("cut", { exact: true }).selectOption({ index: 0 });
  assert.ok(difference(whole, await picture(page)) < 0.001, "closed again");
}

async function darkAndNarrow(browser, file) {
  const { page, wrong, close } = await openPage(browser, file, {
    viewport: { width: 390, height: 800 },
    colorScheme: "dark",
  });
  await viewOpens(page);
  const seen = await picture(page);
  assert.ok(covered(seen) > 0.03, "blank on a phone");
  assert.ok(seen.bytes[0] < 80, "not dark");
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `${wide} pixels on a phone of 390`);
  assert.deepEqual(wrong, []);
  await close();
}

async function printed(browser, file) {
  const { page, close } = await openPage(browser, file);
  await viewOpens(page);
  await page.emulateMedia({ media: "print" });
  assert.equal(await page.locator("#viewer").isVisible(), false, "the view is printed");
  assert.equal(await page.locator("#pictures img").first().isVisible(), true);
  await close();
}
