// SPDX-License-Identifier: Apache-2.0
// What it takes to open a page: its size and, in headless Chromium without a graphics card, the
// time to the first picture, on the clock and of processors.
//
//   node open.mjs CHROMIUM PAGE...
import { statSync } from "node:fs";
import { launch, openPage, viewOpens } from "./opened.mjs";

const [chromium, ...files] = process.argv.slice(2);

async function processorSeconds(session) {
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  return processInfo.reduce((sum, { cpuTime }) => sum + cpuTime, 0);
}

for (const file of files) {
  const browser = await launch(chromium);
  const session = await browser.newBrowserCDPSession();
  const before = await processorSeconds(session);
  const { page } = await openPage(browser, file);
  await viewOpens(page);
  const seconds = (await processorSeconds(session)) - before;
  const clock = await page.locator("#viewer").getAttribute("data-milliseconds");
  const megabytes = statSync(file).size / 1e6;
  console.log(`${file}: ${megabytes.toFixed(1)} MB, ${clock} ms, ${seconds.toFixed(2)} s of processors`);
  await browser.close();
}
