// SPDX-License-Identifier: Apache-2.0
// The 3D view of a page: finds what the page holds, unpacks it and shows it.

import { Body } from "./body";
import { Eye, looks } from "./camera";
import { element } from "./dom";
import type { Header } from "./header";
import { Paint } from "./paint";
import { bodyList, colourGroup, cutGroup, looksBar, sideLetters, timeBar } from "./panel";
import { Scene } from "./scene";
import { Stage } from "./stage";
import style from "./style.css";
import { inflated } from "./unpack";

function textOf(id: string): string {
  return document.getElementById(id)!.textContent!;
}

function hasWebGl(): boolean {
  return document.createElement("canvas").getContext("webgl2") !== null;
}

/** The picture's ground follows the page's, light or dark. */
function followTheme(stage: Stage): void {
  const apply = (): void => {
    const colour = getComputedStyle(stage.canvas.parentElement!).backgroundColor;
    const [r, g, b] = (colour.match(/[\d.]+/g) ?? ["255", "255", "255"]).map(Number);
    stage.renderer.setBackground(r! / 255, g! / 255, b! / 255);
    stage.redraw();
  };
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", apply);
  apply();
}

async function open(place: HTMLElement): Promise<void> {
  const begin = performance.now();
  const header = JSON.parse(textOf("viewer-scene")) as Header;
  const data = await inflated(textOf("viewer-data"));
  const bodies = header.bodies.map((packed) => new Body(packed, data));
  const moves = header.times.length > 1;

  document.head.append(element("style", {}, style));
  const frame = element("div", { class: "stage" });
  const side = element("div", { class: "panel" });
  const picture = element("div", { class: "picture" });
  picture.append(frame);
  place.replaceChildren(picture, side);
  const stage = new Stage(frame);
  const paint = new Paint(header.quantities, header.ramp, bodies);
  const scene = new Scene(bodies, paint, stage, header.times.length);
  const eye = new Eye(stage, scene.least, scene.most);
  stage.canvas.tabIndex = 0;
  stage.canvas.setAttribute("role", "img");
  stage.canvas.setAttribute(
    "aria-label",
    `3D view of ${bodies.length} bodies. Arrow keys turn it, with Shift they move it; ` +
      "plus and minus zoom, 0 goes back to the front.",
  );
  frame.append(...sideLetters(eye, stage));
  picture.prepend(looksBar(eye));
  if (moves) picture.append(timeBar(scene, header.times));
  side.append(
    bodyList(scene, moves ? "Bodies" : "Tissues"),
    colourGroup(scene, header.ramp, moves ? "body" : "tissue"),
    cutGroup(scene),
  );
  followTheme(stage);
  eye.look(looks[0]!);
  scene.update();
  stage.draw();
  place.dataset.milliseconds = String(Math.round(performance.now() - begin));
  place.dataset.state = "open";
}

const place = document.getElementById("viewer");
if (place)
  (hasWebGl() ? open(place) : Promise.reject(new Error("this browser draws no WebGL 2"))).catch(
    (error: Error) => {
      place.dataset.state = "failed";
      place.replaceChildren(
        element("p", {}, `The 3D view cannot be shown: ${error.message}. Pictures follow below.`),
      );
    },
  );
