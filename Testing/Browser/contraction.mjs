// SPDX-License-Identifier: Apache-2.0
// A block that contracts while a bone shortens it: the view follows time.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { numbersOf, openPage, picture, viewOpens } from "./opened.mjs";
import { covered, difference } from "./picture.mjs";

const scene = `title: a block <isometric> & "fixed"
bodies:
  muscle:
    mesh: block.mesh
    material: teran2003_muscle
    fibres: {from: laplace}
    activation: [[0, 0], [0.5, 0.6]]
bones:
  plate:
    surface: plate.obj
    motion:
      - {time: 0, translation: [0, 0, 0]}
      - {time: 0.5, translation: [0, 0, -3]}
attachments:
  - {body: muscle, to: fixed, plane: {point: [0, 0, 0], normal: [0, 0, 1], within: 0.1}, end: origin}
  - {body: muscle, to: plate, plane: {point: [0, 0, 18], normal: [0, 0, 1], within: 0.1}, end: insertion}
time: {end: 0.5, step: 0.125}
output: {every: 0.125}
`;

// Cubes of five tetrahedra, mirrored by turns so that their diagonals meet; in MEDIT's format.
function block([nx, ny, nz], side) {
  const node = (i, j, k) => 1 + i + (nx + 1) * (j + (ny + 1) * k);
  const points = [];
  for (let k = 0; k <= nz; ++k)
    for (let j = 0; j <= ny; ++j)
      for (let i = 0; i <= nx; ++i) points.push(`${side * i} ${side * j} ${side * k} 0`);
  const tets = [];
  const five = [[0, 1, 2, 4], [3, 2, 1, 7], [5, 4, 7, 1], [6, 7, 4, 2], [1, 2, 4, 7]];
  for (let k = 0; k < nz; ++k)
    for (let j = 0; j < ny; ++j)
      for (let i = 0; i < nx; ++i) {
        const odd = (i + j + k) % 2;
        const corner = (c) => node(i + ((c & 1) ^ odd), j + ((c >> 1) & 1), k + (c >> 2));
        for (const tet of five) {
          const corners = tet.map(corner);
          if (odd) corners.unshift(corners.splice(1, 1)[0]);
          tets.push(`${corners.join(" ")} 1`);
        }
      }
  return `MeshVersionFormatted 2\nDimension 3\nVertices\n${points.length}\n${points.join("\n")}\n` +
    `Tetrahedra\n${tets.length}\n${tets.join("\n")}\nEnd\n`;
}

const plate = `v -2 -2 18
v 14 -2 18
v 14 14 18
v -2 14 18
v -2 -2 20
v 14 -2 20
v 14 14 20
v -2 14 20
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
`;

export function make({ run, folder }) {
  writeFileSync(join(folder, "block.mesh"), block([4, 4, 6], 3));
  writeFileSync(join(folder, "plate.obj"), plate);
  writeFileSync(join(folder, "scene.yaml"), scene);
  run("contract", "scene.yaml", "-o", "out", "--quiet");
  run("contract", "scene.yaml", "-o", "series", "--series", "xdmf", "--no-pictures", "--quiet");
}

export async function use({ browser, folder }) {
  const { page, wrong, close } = await openPage(browser, join(folder, "out/report.html"));
  const report = JSON.parse(readFileSync(join(folder, "out/report.json"), "utf8"));
  await viewOpens(page);
  assert.equal(await page.locator("h1").innerText(), 'a block <isometric> & "fixed"');
  const numbers = await numbersOf(page);
  for (const [name, column] of Object.entries(report.history))
    if (!name.startsWith("time"))
      for (const key of ["first", "last", "least", "most"])
        assert.ok(numbers.has(column[key]), `${name} ${key}`);

  const first = await picture(page);
  assert.ok(covered(first) > 0.05, "the picture is blank");
  await timeMoves(page, first);
  await quantitiesChange(page);
  await fibresShow(page);
  assert.deepEqual(wrong, []);
  await close();
  await seriesShowsTheSame(browser, join(folder, "series/report.html"), first);
}

async function seriesShowsTheSame(browser, file, first) {
  const { page, wrong, close } = await openPage(browser, file);
  await viewOpens(page);
  assert.ok(difference(first, await picture(page)) < 0.001, "an XDMF series shows something else");
  await page.getByLabel("time", { exact: true }).fill("4");
  assert.ok(difference(first, await picture(page)) > 0.02, "its shape stays");
  assert.deepEqual(wrong, []);
  await close();
}

async function timeMoves(page, first) {
  const time = page.getByLabel("time", { exact: true });
  await time.focus();
  await page.keyboard.press("End");
  const last = await picture(page);
  assert.ok(difference(first, last) > 0.02, "the shape stays");
  assert.equal(await page.locator("#viewer .time output").innerText(), "t = 0.500 s");
  await page.keyboard.press("Home");
  assert.ok(difference(first, await picture(page)) < 0.001, "the beginning is not as before");
  const play = page.getByRole("button", { name: "play the contraction" });
  await play.click();
  await page.waitForFunction(() => document.querySelector("#viewer .time input").value === "2");
  await play.click();
  await time.fill("0");
}

async function quantitiesChange(page) {
  const plain = await picture(page);
  const colour = page.getByLabel("colour by");
  for (const name of ["activation", "fibre stretch", "stress (von Mises), MPa", "aspect ratio"]) {
    await colour.selectOption({ label: name });
    assert.ok(difference(plain, await picture(page)) > 0.02, name);
  }
  await colour.selectOption({ label: "activation" });
  const before = await picture(page);
  await page.getByLabel("time", { exact: true }).fill("4");
  const after = await picture(page);
  assert.ok(difference(before, after) > 0.02, "activation over time");
  await page.getByLabel("time", { exact: true }).fill("0");
  await colour.selectOption({ index: 0 });
}

async function fibresShow(page) {
  const plain = await picture(page);
  await page.getByLabel("fibre directions").check();
  assert.ok(difference(plain, await picture(page)) > 0.01, "fibres");
  await page.getByLabel("fibre directions").uncheck();
  assert.ok(difference(plain, await picture(page)) < 0.001, "fibres go");
}
