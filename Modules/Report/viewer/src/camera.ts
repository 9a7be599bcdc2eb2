// SPDX-License-Identifier: Apache-2.0
// Where one looks from: the patient's directions, gestures and keys. LPS: x to the patient's
// left, y to the back, z to the head.

import type { Stage } from "./stage";
import type { Triple } from "./header";

export interface Look {
  name: string;
  direction: Triple; // from the eye
  up: Triple;
}

export const looks: Look[] = [
  { name: "Front", direction: [0, 1, 0], up: [0, 0, 1] },
  { name: "Back", direction: [0, -1, 0], up: [0, 0, 1] },
  { name: "Left", direction: [-1, 0, 0], up: [0, 0, 1] },
  { name: "Right", direction: [1, 0, 0], up: [0, 0, 1] },
  { name: "Above", direction: [0, 0, -1], up: [0, -1, 0] },
  { name: "Below", direction: [0, 0, 1], up: [0, -1, 0] },
];

const letters = ["RL", "AP", "IS"]; // of an axis, towards less and more

/** "L", or "LA" where it is between: the sides that a direction points to, the nearest first. */
export function sideOf(direction: Triple): string {
  const told = 0.35; // share of the direction
  return [0, 1, 2]
    .filter((axis) => Math.abs(direction[axis]!) > told)
    .sort((a, b) => Math.abs(direction[b]!) - Math.abs(direction[a]!))
    .map((axis) => letters[axis]![direction[axis]! > 0 ? 1 : 0])
    .join("");
}

function cross(a: Triple, b: Triple): Triple {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

const keyTurn = 10; // degrees
const keyShift = 0.05; // of the picture's height
const keyZoom = 1.15;

export class Eye {
  constructor(
    private readonly stage: Stage,
    private readonly least: Triple,
    private readonly most: Triple,
  ) {
    stage.camera.setParallelProjection(true);
    this.listen();
  }

  /** The whole box, from a side. */
  look(look: Look): void {
    const camera = this.stage.camera;
    const middle = [0, 1, 2].map((i) => (this.least[i]! + this.most[i]!) / 2) as Triple;
    const extent = [0, 1, 2].map((i) => this.most[i]! - this.least[i]!) as Triple;
    const far = Math.hypot(...extent) || 1;
    const right = cross(look.direction, look.up);
    const span = (d: Triple): number =>
      Math.abs(d[0]) * extent[0] + Math.abs(d[1]) * extent[1] + Math.abs(d[2]) * extent[2];
    const room = 1.08;
    const high = Math.max(span(look.up), span(right) / this.stage.slimness, 1e-6);
    camera.setFocalPoint(...middle);
    camera.setPosition(
      middle[0] - far * look.direction[0],
      middle[1] - far * look.direction[1],
      middle[2] - far * look.direction[2],
    );
    camera.setViewUp(...look.up);
    camera.setParallelScale((room * high) / 2);
    this.stage.redraw();
  }

  turn(right: number, up: number): void {
    const camera = this.stage.camera;
    camera.azimuth(-right);
    camera.elevation(-up);
    camera.orthogonalizeViewUp();
    this.stage.redraw();
  }

  /** Parts of the picture's height. */
  shift(right: number, up: number): void {
    const camera = this.stage.camera;
    const by = 2 * camera.getParallelScale();
    const { rightwards, upwards } = this.sides();
    const moved = (p: number[]): Triple =>
      [0, 1, 2].map((i) => p[i]! - by * (right * rightwards[i]! + up * upwards[i]!)) as Triple;
    camera.setFocalPoint(...moved(camera.getFocalPoint()));
    camera.setPosition(...moved(camera.getPosition()));
    this.stage.redraw();
  }

  zoom(factor: number): void {
    const camera = this.stage.camera;
    camera.setParallelScale(camera.getParallelScale() / factor);
    this.stage.redraw();
  }

  /** Directions of the picture's right and upper side. */
  sides(): { rightwards: Triple; upwards: Triple } {
    const camera = this.stage.camera;
    const upwards = camera.getViewUp() as Triple;
    return {
      rightwards: cross(camera.getDirectionOfProjection() as Triple, upwards),
      upwards,
    };
  }

  private listen(): void {
    const canvas = this.stage.canvas;
    const held = new Map<number, { x: number; y: number }>();
    let apart = 0;
    const distance = (): number => {
      const [a, b] = [...held.values()];
      return Math.hypot(a!.x - b!.x, a!.y - b!.y);
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      held.set(event.pointerId, { x: event.clientX, y: event.clientY });
      if (held.size === 2) apart = distance();
    });
    canvas.addEventListener("pointermove", (event) => {
      const before = held.get(event.pointerId);
      if (!before) return;
      const dx = event.clientX - before.x;
      const dy = event.clientY - before.y;
      held.set(event.pointerId, { x: event.clientX, y: event.clientY });
      const height = Math.max(this.stage.height, 1);
      if (held.size === 2) {
        const now = distance();
        this.zoom(now / Math.max(apart, 1));
        apart = now;
        this.shift(dx / height / 2, -dy / height / 2);
      } else if (event.shiftKey || event.buttons > 1) {
        this.shift(dx / height, -dy / height);
      } else {
        this.turn((dx / height) * 180, (-dy / height) * 180);
      }
    });
    const release = (event: PointerEvent): void => void held.delete(event.pointerId);
    canvas.addEventListener("pointerup", release);
    canvas.addEventListener("pointercancel", release);
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    // The page scrolls until the picture was clicked on.
    canvas.addEventListener(
      "wheel",
      (event) => {
        if (document.activeElement !== canvas) return;
        event.preventDefault();
        this.zoom(Math.exp(-event.deltaY / 500));
      },
      { passive: false },
    );
    canvas.addEventListener("keydown", (event) => this.press(event));
  }

  private press(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const move = (right: number, up: number): void =>
      event.shiftKey
        ? this.shift(keyShift * right, keyShift * up)
        : this.turn(keyTurn * right, keyTurn * up);
    const keys: Record<string, () => void> = {
      ArrowLeft: () => move(-1, 0),
      ArrowRight: () => move(1, 0),
      ArrowUp: () => move(0, 1),
      ArrowDown: () => move(0, -1),
      "+": () => this.zoom(keyZoom),
      "=": () => this.zoom(keyZoom),
      "-": () => this.zoom(1 / keyZoom),
      "0": () => this.look(looks[0]!),
    };
    const act = keys[event.key];
    if (!act) return;
    event.preventDefault();
    act();
  }
}
