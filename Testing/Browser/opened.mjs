// SPDX-License-Identifier: Apache-2.0
// A page in a browser without a display, and what it did wrong.
import assert from "node:assert/strict";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";
import { decoded } from "./picture.mjs";

const flags = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];

const patience = 240000; // ms; machines that test are busy

export async function launch(executablePath) {
  return chromium.launch({ executablePath, args: flags, timeout: patience });
}

/** Opens report.html of a folder; the page records its errors and requests. */
export async function openPage(browser, file, options = {}) {
  const context = await browser.newContext({ viewport: { width: 1180, height: 1400 }, ...options });
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  const wrong = [];
  const url = pathToFileURL(file).href;
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) wrong.push(`console: ${message.text()}`);
  });
  page.on("pageerror", (error) => wrong.push(`error: ${error.message}`));
  page.on("request", (request) => {
    const asked = request.url();
    if (asked !== url && !asked.startsWith("data:")) wrong.push(`request: ${asked.slice(0, 200)}`);
  });
  await page.goto(url);
  return { page, wrong, close: () => context.close() };
}

/** Waits until the 3D view has drawn. */
export async function viewOpens(page) {
  await page.waitForSelector("#viewer[data-state=open], #viewer[data-state=failed]", {
    timeout: patience,
  });
  const said = await page.locator("#viewer").getAttribute("data-state");
  assert.equal(said, "open", await page.locator("#viewer").innerText());
}

export async function settled(page) {
  await page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
  );
}

/** The 3D picture as it is now. */
export async function picture(page) {
  await settled(page);
  return decoded(await page.locator("#viewer canvas").screenshot());
}

/** All numbers that the page's tables and facts hold. */
export async function numbersOf(page) {
  return new Set(
    await page.locator("data[value]").evaluateAll((all) => all.map((one) => Number(one.value))),
  );
}
