// SPDX-License-Identifier: Apache-2.0
// What the reader has chosen, and the pieces that show it.

import type { Body } from "./body";
import { isBefore, opened } from "./cut";
import type { Opened, Plane } from "./cut";
import type { Triple } from "./header";
import { Paint, rgbOf } from "./paint";
import { Piece, Stage } from "./stage";

const fibreOpacity = 0.25; // of bodies whose fibres are shown
const shortestEdge = 6; // pixels; the edges of a cut are not drawn when they would fill it

interface Shown {
  body: Body;
  skin: Piece;
  inside: Piece;
  fibres: Piece;
  visible: boolean;
  opacity: number;
  open: Opened | null; // of the present cut and time; null: to be found
  edge: number; // mean length in the cut, mm
}

function meanEdge(x: Float32Array, triangles: Int32Array): number {
  const sampled = 3000;
  let sum = 0;
  let count = 0;
  for (let i = 0; i < Math.min(triangles.length, sampled); i += 3, ++count) {
    const [a, b] = [3 * triangles[i]!, 3 * triangles[i + 1]!];
    sum += Math.hypot(x[a]! - x[b]!, x[a + 1]! - x[b + 1]!, x[a + 2]! - x[b + 2]!);
  }
  return count > 0 ? sum / count : 0;
}

export class Scene {
  readonly shown: Shown[];
  readonly least: Triple = [Infinity, Infinity, Infinity];
  readonly most: Triple = [-Infinity, -Infinity, -Infinity];
  plane: Plane | null = null;
  quantity = -1; // of the paint; below 0: each body in its own colour
  time = 0;
  edges = false;
  fibres = false;

  constructor(
    readonly bodies: Body[],
    readonly paint: Paint,
    private readonly stage: Stage,
    times: number,
  ) {
    this.shown = bodies.map((body) => {
      const colour = rgbOf(body.colour);
      const [skin, inside, fibres] = [new Piece(colour), new Piece(colour), new Piece([20, 20, 24])];
      for (const piece of [skin, inside, fibres]) stage.renderer.addActor(piece.actor);
      return { body, skin, inside, fibres, visible: true, opacity: 1, open: null, edge: 0 };
    });
    stage.beforeDrawing = () => {
      for (const one of this.shown)
        one.inside.actor
          .getProperty()
          .setEdgeVisibility(
            one.opacity === 1 && (this.edges || one.edge * stage.pixelsPerMm > shortestEdge),
          );
    };
    for (const body of bodies)
      for (let time = 0; time < Math.max(times, 1); ++time) this.include(body.points(time));
  }

  private include(points: Float32Array): void {
    for (let i = 0; i < points.length; ++i) {
      const axis = i % 3;
      if (points[i]! < this.least[axis]!) this.least[axis] = points[i]!;
      if (points[i]! > this.most[axis]!) this.most[axis] = points[i]!;
    }
  }

  /** After a change of the cut or the time. */
  reshape(): void {
    for (const one of this.shown) one.open = null;
    this.update();
  }

  setPlane(plane: Plane | null): void {
    this.plane = plane;
    this.reshape();
  }

  setTime(time: number): void {
    this.time = time;
    this.reshape();
  }

  setQuantity(quantity: number): void {
    this.quantity = quantity;
    for (const one of this.shown) one.open = null;
    this.update();
  }

  /** Brings the pieces up to what was chosen; hidden bodies wait until they are shown. */
  update(): void {
    for (const one of this.shown) {
      this.style(one);
      if (!one.visible || one.open) continue;
      const x = one.body.points(this.time);
      one.open = opened(one.body.mesh, x, this.plane);
      one.edge = meanEdge(x, one.open.inside.triangles);
      for (const [piece, drawn] of [
        [one.skin, one.open.skin],
        [one.inside, one.open.inside],
      ] as const)
        piece.show(
          x,
          drawn,
          this.quantity < 0
            ? null
            : this.paint.colours(one.body, drawn, this.quantity, this.time),
        );
      if (this.fibres && one.body.fibreStep > 0) this.drawFibres(one);
    }
    this.stage.redraw();
  }

  setFibres(on: boolean): void {
    this.fibres = on;
    for (const one of this.shown) if (on && one.body.fibreStep > 0) this.drawFibres(one);
    this.update();
  }

  private drawFibres(one: Shown): void {
    const plane = this.plane;
    one.fibres.showLines(
      one.body.fibreLines(
        this.time,
        (x, y, z) => !plane || !isBefore(plane, [x, y, z][plane.axis]!),
      ),
    );
  }

  private style(one: Shown): void {
    const fibred = this.fibres && one.body.fibreStep > 0;
    const opacity = fibred ? Math.min(one.opacity, fibreOpacity) : one.opacity;
    for (const piece of [one.skin, one.inside]) {
      piece.actor.setVisibility(one.visible && opacity > 0);
      piece.actor.getProperty().setOpacity(opacity);
    }
    one.skin.actor.getProperty().setEdgeVisibility(this.edges);
    one.fibres.actor.setVisibility(one.visible && fibred);
  }
}
