// SPDX-License-Identifier: Apache-2.0
// Which colour a triangle has.

import type { Body } from "./body";
import type { Drawn } from "./cut";
import type { Limits } from "./header";
import { shapeNames, shapesOf } from "./shape";

export type Rgb = [number, number, number]; // 0 to 255

export function rgbOf(css: string): Rgb {
  const whole = parseInt(css.slice(1), 16);
  return [whole >> 16, (whole >> 8) & 255, whole & 255];
}

const noValue: Rgb = [179, 179, 179];
const steps = 255;

/** What bodies may be coloured by: quantities of the page, then shapes of tetrahedra. */
export class Paint {
  readonly quantities: Limits[] = [];
  private readonly packed: number; // quantities before it come with the page
  private readonly ramp = new Uint8Array(3 * steps);
  private shapes = new Map<Body, { time: number; all: Float32Array[] }>();

  constructor(
    packed: Limits[],
    colours: string[],
    private readonly bodies: Body[],
  ) {
    this.packed = packed.length;
    this.quantities.push(...packed);
    if (bodies.some((body) => body.tetCount > 0))
      for (const name of shapeNames) this.quantities.push({ name, least: NaN, most: NaN });
    const stops = colours.map(rgbOf);
    for (let i = 0; i < steps; ++i) {
      const at = (i / (steps - 1)) * (stops.length - 1);
      const before = Math.min(Math.floor(at), stops.length - 2);
      for (let c = 0; c < 3; ++c) {
        const from = stops[before]![c]!;
        this.ramp[3 * i + c] = Math.round(from + (at - before) * (stops[before + 1]![c]! - from));
      }
    }
  }

  /** Limits of shapes are found when they are asked for: the least and most at rest. */
  limits(quantity: number): Limits {
    const limits = this.quantities[quantity]!;
    if (Number.isNaN(limits.least)) {
      limits.least = Infinity;
      limits.most = -Infinity;
      for (const body of this.bodies)
        for (const value of this.shapesAt(body, 0)[quantity - this.packed]!) {
          limits.least = Math.min(limits.least, value);
          limits.most = Math.max(limits.most, value);
        }
    }
    return limits;
  }

  /** Three bytes a triangle; null: the body has no such values. */
  colours(body: Body, drawn: Drawn, quantity: number, time: number): Uint8Array | null {
    const valueOf = this.valuesOf(body, drawn, quantity, time);
    if (!valueOf) return null;
    const colours = new Uint8Array(drawn.triangles.length);
    for (let f = 0; f < drawn.owners.length; ++f) {
      const step = valueOf(f);
      for (let c = 0; c < 3; ++c)
        colours[3 * f + c] = step < 0 ? noValue[c]! : this.ramp[3 * step + c]!;
    }
    return colours;
  }

  /** The ramp's step for a triangle; below 0: it has no value. */
  private valuesOf(
    body: Body,
    drawn: Drawn,
    quantity: number,
    time: number,
  ): ((f: number) => number) | null {
    if (quantity >= this.packed) {
      if (body.tetCount === 0) return null;
      const { least, most } = this.limits(quantity);
      const values = this.shapesAt(body, time)[quantity - this.packed]!;
      const scale = (steps - 1) / Math.max(most - least, 1e-12);
      return (f) => {
        const step = Math.round(scale * (values[drawn.owners[f]!]! - least));
        return Math.min(steps - 1, Math.max(0, step));
      };
    }
    const values = body.valuesAt(quantity, time);
    if (!values) return null;
    const bytes = values.bytes;
    if (values.at === "tets") return (f) => (bytes[drawn.owners[f]!]! + 1) % 256 - 1;
    return (f) => {
      let sum = 0;
      for (let i = 0; i < 3; ++i) {
        const byte = bytes[drawn.triangles[3 * f + i]!]!;
        if (byte === 255) return -1;
        sum += byte;
      }
      return Math.round(sum / 3);
    };
  }

  private shapesAt(body: Body, time: number): Float32Array[] {
    const known = this.shapes.get(body);
    if (known && known.time === time) return known.all;
    const all = shapesOf(body.mesh.tets, body.points(time));
    this.shapes.set(body, { time, all });
    return all;
  }
}
