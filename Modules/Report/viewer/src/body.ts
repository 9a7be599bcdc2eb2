// SPDX-License-Identifier: Apache-2.0
import type { PackedBody } from "./header";
import { part, readMoments, readTets, readTriangles, readValues } from "./unpack";
import type { Mesh } from "./unpack";

/** Values at points or tetrahedra, by time; one time: they do not change. */
export interface Values {
  at: "points" | "tets";
  times: Uint8Array[];
}

/** A body, unpacked. */
export class Body {
  readonly name: string;
  readonly colour: string;
  readonly mesh: Mesh;
  readonly values = new Map<number, Values>(); // by quantity
  readonly fibreStep: number; // 0: none
  private readonly moments: Float32Array[];
  private readonly fibreBytes: Uint8Array | null;

  constructor(packed: PackedBody, data: Uint8Array) {
    this.name = packed.name;
    this.colour = packed.colour;
    const connectivity = part(data, packed.connectivity);
    this.mesh =
      packed.tets > 0 ? readTets(packed, connectivity) : readTriangles(packed, connectivity);
    this.moments = readMoments(packed, this.mesh, part(data, packed.coordinates));
    for (const { quantity, at, bytes, times } of packed.values) {
      const count = at === "tets" ? packed.tets : packed.points;
      this.values.set(quantity, { at, times: readValues(count, times, part(data, bytes)) });
    }
    this.fibreStep = packed.fibres ? packed.fibres.step : 0;
    this.fibreBytes = packed.fibres ? part(data, packed.fibres.bytes) : null;
  }

  get tetCount(): number {
    return this.mesh.tets.length / 4;
  }

  points(time: number): Float32Array {
    return this.moments[Math.min(time, this.moments.length - 1)]!;
  }

  valuesAt(quantity: number, time: number): { at: "points" | "tets"; bytes: Uint8Array } | null {
    const found = this.values.get(quantity);
    if (!found) return null;
    return { at: found.at, bytes: found.times[Math.min(time, found.times.length - 1)]! };
  }

  /** Ends of short lines along the fibres, those before the cut left out. */
  fibreLines(time: number, isShown: (x: number, y: number, z: number) => boolean): Float32Array {
    if (!this.fibreBytes) return new Float32Array(0);
    const samples = Math.ceil(this.tetCount / this.fibreStep);
    const moments = this.fibreBytes.length / (3 * samples);
    const offset = 3 * samples * Math.min(time, moments - 1);
    const x = this.points(time);
    const tets = this.mesh.tets;
    const half = 0.5 * this.fibreLength(x, samples);
    const ends: number[] = [];
    for (let s = 0; s < samples; ++s) {
      const at = offset + 3 * s;
      const d = [0, 1, 2].map((axis) => ((this.fibreBytes![at + axis]! << 24) >> 24) / 127);
      if (d[0] === 0 && d[1] === 0 && d[2] === 0) continue;
      const corner = 4 * s * this.fibreStep;
      const c = [0, 1, 2].map((axis) => {
        let sum = 0;
        for (let i = 0; i < 4; ++i) sum += x[3 * tets[corner + i]! + axis]!;
        return sum / 4;
      });
      if (!isShown(c[0]!, c[1]!, c[2]!)) continue;
      for (const sign of [-half, half])
        for (let axis = 0; axis < 3; ++axis) ends.push(c[axis]! + sign * d[axis]!);
    }
    return Float32Array.from(ends);
  }

  /** The side of a cube of the body's volume a line: about the distance between them, mm. */
  private fibreLength(x: Float32Array, samples: number): number {
    const tets = this.mesh.tets;
    let volume = 0;
    for (let t = 0; t < tets.length; t += 4) {
      const [a, b, c, d] = [0, 1, 2, 3].map((i) => 3 * tets[t + i]!) as [
        number,
        number,
        number,
        number,
      ];
      const e = (p: number, axis: number): number => x[p + axis]! - x[a + axis]!;
      volume +=
        (e(b, 0) * (e(c, 1) * e(d, 2) - e(c, 2) * e(d, 1)) -
          e(b, 1) * (e(c, 0) * e(d, 2) - e(c, 2) * e(d, 0)) +
          e(b, 2) * (e(c, 0) * e(d, 1) - e(c, 1) * e(d, 0))) /
        6;
    }
    return Math.cbrt(Math.abs(volume) / Math.max(samples, 1));
  }
}
