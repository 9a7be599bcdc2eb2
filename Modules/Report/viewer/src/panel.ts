// SPDX-License-Identifier: Apache-2.0
// What the reader chooses with: the list of bodies, colours, the cut, time.

import { looks, sideOf } from "./camera";
import type { Eye } from "./camera";
import { breakable, button, checkbox, choice, element, readable, slider } from "./dom";
import type { Scene } from "./scene";
import type { Stage } from "./stage";

function group(title: string, ...children: Node[]): HTMLElement {
  return element("fieldset", {}, element("legend", {}, title), ...children);
}

function labelled(text: string, ...inputs: Node[]): HTMLElement {
  return element("label", {}, ...inputs, element("span", {}, text));
}

/** Buttons for the patient's directions. */
export function looksBar(eye: Eye): HTMLElement {
  const bar = element("div", {
    class: "looks",
    role: "group",
    "aria-label": "Look at it from",
  });
  for (const look of looks)
    bar.append(button(look.name, `from ${look.name.toLowerCase()}`, () => eye.look(look)));
  return bar;
}

/** The patient's sides at the picture's edges. */
export function sideLetters(eye: Eye, stage: Stage): HTMLElement[] {
  const places = ["right", "left", "top", "bottom"];
  const made = places.map((place) =>
    element("span", { class: `side ${place}`, "aria-hidden": "true" }),
  );
  const before = stage.afterDrawing;
  stage.afterDrawing = () => {
    before();
    const { rightwards, upwards } = eye.sides();
    const minus = (d: [number, number, number]): [number, number, number] => [-d[0], -d[1], -d[2]];
    [rightwards, minus(rightwards), upwards, minus(upwards)].forEach((direction, i) => {
      made[i]!.textContent = sideOf(direction);
    });
  };
  return made;
}

/** A row a body: shown or not, alone, how opaque. */
export function bodyList(scene: Scene, title: string): HTMLElement {
  const list = element("ul", { class: "bodies" });
  const boxes: HTMLInputElement[] = [];
  const show = (visible: (i: number) => boolean): void => {
    scene.shown.forEach((one, i) => {
      one.visible = visible(i);
      boxes[i]!.checked = one.visible;
    });
    scene.update();
  };
  const opacities = scene.shown.map((one, i) => {
    const box = checkbox(true, (checked) => {
      one.visible = checked;
      scene.update();
    });
    boxes.push(box);
    const opacity = slider(
      `opacity of ${one.body.name}`,
      { least: 0, most: 1, step: 0.05, value: 1 },
      (value) => {
        one.opacity = value;
        scene.update();
      },
    );
    const swatch = element("span", { class: "swatch" });
    swatch.style.background = one.body.colour;
    list.append(
      element(
        "li",
        {},
        element("label", {}, box, swatch, breakable(one.body.name)),
        button("only", `show only ${one.body.name}`, () => show((j) => j === i)),
        opacity,
      ),
    );
    return opacity;
  });
  const everyOpacity = slider(
    "opacity of all",
    { least: 0, most: 1, step: 0.05, value: 1 },
    (value) => {
      scene.shown.forEach((one, i) => {
        one.opacity = value;
        opacities[i]!.value = String(value);
      });
      scene.update();
    },
  );
  const all = element(
    "div",
    { class: "row" },
    button("all", "show all", () => show(() => true)),
    button("none", "show none", () => show(() => false)),
    element("span", { class: "grow" }, "opacity of all"),
    everyOpacity,
  );
  return group(title, all, list);
}

/** What bodies are coloured by, and what the colours mean. */
export function colourGroup(scene: Scene, ramp: string[], own: string): HTMLElement {
  const legend = element("div", { class: "ramp", hidden: "" });
  const bar = element("div", { class: "bar-of-colours" });
  bar.style.background = `linear-gradient(to right, ${ramp.join(",")})`;
  const least = element("span");
  const most = element("span");
  legend.append(bar, element("div", { class: "row ends" }, least, most));
  const select = choice([own, ...scene.paint.quantities.map((q) => q.name)], (index) => {
    legend.hidden = index === 0;
    if (index > 0) {
      const limits = scene.paint.limits(index - 1);
      least.textContent = readable(limits.least);
      most.textContent = readable(limits.most);
    }
    scene.setQuantity(index - 1);
  });
  select.setAttribute("aria-label", "colour by");
  const edges = checkbox(false, (checked) => {
    scene.edges = checked;
    scene.update();
  });
  const made = group("Colour", select, legend, labelled("edges of the mesh", edges));
  if (scene.bodies.some((body) => body.fibreStep > 0)) {
    const fibres = checkbox(false, (checked) => scene.setFibres(checked));
    made.append(labelled("fibre directions", fibres));
  }
  return made;
}

const axes = ["left to right", "front to back", "above to below"];

/** A plane that takes away what is before it. */
export function cutGroup(scene: Scene): HTMLElement {
  // The part that goes first is on the patient's left, in front, and above.
  const signs = [1, -1, 1] as const;
  let axis = -1;
  let part = 0.5;
  let turned = false;
  const said = element("output");
  const apply = (): void => {
    position.disabled = other.disabled = axis < 0;
    if (axis < 0) {
      said.textContent = "";
      scene.setPlane(null);
      return;
    }
    const side = axis as 0 | 1 | 2;
    const sign = signs[side];
    const [least, most] = [scene.least[side], scene.most[side]];
    const at = sign > 0 ? most - part * (most - least) : least + part * (most - least);
    said.textContent = `${"xyz"[side]} = ${at.toFixed(1)} mm`;
    position.setAttribute("aria-valuetext", said.textContent);
    scene.setPlane({ axis: side, sign: turned ? (-sign as 1 | -1) : sign, at });
  };
  const select = choice(["no cut", ...axes], (index) => {
    axis = index - 1;
    apply();
  });
  select.setAttribute("aria-label", "cut");
  const position = slider(
    "where the cut is",
    { least: 0, most: 1, step: 0.005, value: part },
    (value) => {
      part = value;
      apply();
    },
  );
  const other = checkbox(false, (checked) => {
    turned = checked;
    apply();
  });
  position.disabled = other.disabled = true;
  return group("Cut", select, position, said, labelled("the other side", other));
}

const playEvery = 200; // ms

/** A slider over the moments, and a button that plays them. */
export function timeBar(scene: Scene, times: number[]): HTMLElement {
  const said = element("output");
  let timer = 0;
  const show = (time: number): void => {
    range.value = String(time);
    said.textContent = `t = ${times[time]!.toFixed(3)} s`;
    range.setAttribute("aria-valuetext", said.textContent);
    scene.setTime(time);
  };
  const stop = (): void => {
    window.clearInterval(timer);
    timer = 0;
    play.textContent = "Play";
  };
  const range = slider(
    "time",
    { least: 0, most: times.length - 1, step: 1, value: 0 },
    (value) => {
      stop();
      show(value);
    },
  );
  const play = button("Play", "play the contraction", () => {
    if (timer) return stop();
    play.textContent = "Pause";
    timer = window.setInterval(() => show((scene.time + 1) % times.length), playEvery);
  });
  said.textContent = `t = ${times[0]!.toFixed(3)} s`;
  return element("div", { class: "controls time" }, play, range, said);
}
