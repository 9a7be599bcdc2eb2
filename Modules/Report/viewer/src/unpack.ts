// SPDX-License-Identifier: Apache-2.0
// Text to bytes to numbers; the other half of Modules/Report/ViewerPack.cpp and TetCode.cpp.

import type { PackedBody, Span } from "./header";

/** Base64 of a zlib stream (RFC 1950), unpacked. */
export async function inflated(base64: string): Promise<Uint8Array> {
  const text = atob(base64);
  const packed = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) packed[i] = text.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export function part(data: Uint8Array, span: Span): Uint8Array {
  return data.subarray(span[0], span[0] + span[1]);
}

/** Whole numbers of 7 bits a byte, the lowest first. */
class Varints {
  private at = 0;
  constructor(private readonly bytes: Uint8Array) {}
  next(): number {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = this.bytes[this.at++]!;
      value |= (byte & 127) << shift;
      if (byte < 128) return value;
    }
  }
}

/** Corners of the face opposite each corner, outward for a positive tetrahedron. */
export const faceCorners = [
  [1, 2, 3],
  [0, 3, 2],
  [0, 1, 3],
  [0, 2, 1],
] as const;

export interface Mesh {
  tets: Int32Array; // 4 a tetrahedron
  triangles: Int32Array; // 3 a triangle of the boundary
  owners: Int32Array; // the tetrahedron behind each; of a surface the triangle itself
  parents: Int32Array; // 4 a point: a, b, c, d of the guess a + b + c - d; see guessed()
}

/** What the numbers of a tetrahedral mesh mean; see TetCode.h. */
const visited = 0;
const outside = 1;
const fresh = 2;

/** Tetrahedra in the order in which they grow over their faces. */
export function readTets(body: PackedBody, bytes: Uint8Array): Mesh {
  const numbers = new Varints(bytes);
  const tets = new Int32Array(4 * body.tets);
  const parents = new Int32Array(4 * body.points).fill(-1);
  const faces: number[] = [];
  const owners: number[] = [];
  const queue = new Int32Array(4 * body.tets);
  let first = 0;
  let last = 0;
  let count = 0;
  let points = 0;
  const corner = (code: number, a: number, b: number, c: number, d: number): number => {
    if (code > fresh) return points - (code - fresh);
    parents.set([a, b, c, d], 4 * points);
    return points++;
  };
  const add = (a: number, b: number, c: number, d: number, open: number): void => {
    tets.set([a, b, c, d], 4 * count);
    for (let face = 0; face < open; ++face) queue[last++] = 4 * count + face;
    ++count;
  };
  while (count < body.tets) {
    const seed: number[] = [];
    for (let i = 0; i < 4; ++i) {
      const before = points > 0 ? points - 1 : -1;
      seed.push(corner(numbers.next(), before, -1, -1, -1));
    }
    add(seed[0]!, seed[1]!, seed[2]!, seed[3]!, 4);
    while (first < last) {
      const gate = queue[first++]!;
      const tet = gate >> 2;
      const face = gate & 3;
      const at = 4 * tet;
      const [i, j, k] = faceCorners[face]!;
      const a = tets[at + i]!;
      const b = tets[at + j]!;
      const c = tets[at + k]!;
      const code = numbers.next();
      if (code === visited) continue;
      if (code === outside) {
        faces.push(a, b, c);
        owners.push(tet);
        continue;
      }
      add(a, b, c, corner(code, a, b, c, tets[at + face]!), 3);
    }
  }
  return { tets, triangles: Int32Array.from(faces), owners: Int32Array.from(owners), parents };
}

/** Triangles one after the other, their points numbered as they come. */
export function readTriangles(body: PackedBody, bytes: Uint8Array): Mesh {
  const numbers = new Varints(bytes);
  const triangles = new Int32Array(3 * body.triangles);
  const parents = new Int32Array(4 * body.points).fill(-1);
  let points = 0;
  for (let i = 0; i < triangles.length; ++i) {
    const code = numbers.next();
    if (code === 0) parents[4 * points] = points - 1;
    triangles[i] = points - code;
    if (code === 0) ++points;
  }
  const owners = Int32Array.from({ length: body.triangles }, (_, i) => i);
  return { tets: new Int32Array(0), triangles, owners, parents };
}

/** The guess of a coordinate from those of earlier points, a whole number. */
function guessed(whole: Uint16Array, parents: Int32Array, point: number, axis: number): number {
  const at = 4 * point;
  const one = parents[at]!;
  if (one < 0) return 0;
  const two = parents[at + 1]!;
  if (two < 0) return whole[3 * one + axis]!;
  const sum =
    whole[3 * one + axis]! + whole[3 * two + axis]! + whole[3 * parents[at + 2]! + axis]!;
  return Math.trunc((2 * sum) / 3) - whole[3 * parents[at + 3]! + axis]!;
}

/** Coordinates at each moment, mm: differences from guesses, low bytes before high ones. */
export function readMoments(body: PackedBody, mesh: Mesh, bytes: Uint8Array): Float32Array[] {
  const count = 3 * body.points;
  const moments: Float32Array[] = [];
  let whole = new Uint16Array(count);
  for (let moment = 0; moment < body.moments; ++moment) {
    const low = bytes.subarray(2 * count * moment, 2 * count * moment + count);
    const high = bytes.subarray(2 * count * moment + count, 2 * count * (moment + 1));
    const next = moment === 0 ? whole : whole.slice();
    const positions = new Float32Array(count);
    for (let point = 0, i = 0; point < body.points; ++point)
      for (let axis = 0; axis < 3; ++axis, ++i) {
        const coded = low[i]! | (high[i]! << 8);
        const difference = (coded >> 1) ^ -(coded & 1);
        const guess = moment === 0 ? guessed(whole, mesh.parents, point, axis) : whole[i]!;
        next[i] = guess + difference; // modulo 65536
        const least = body.least[axis]!;
        positions[i] = least + (next[i]! / 65535) * (body.most[axis]! - least);
      }
    whole = next;
    moments.push(positions);
  }
  return moments;
}

/** Bytes of values at each time: differences from the time before, at first from the neighbour. */
export function readValues(count: number, times: number, bytes: Uint8Array): Uint8Array[] {
  const all: Uint8Array[] = [];
  for (let time = 0; time < times; ++time) {
    const values = new Uint8Array(count);
    const before = all[time - 1];
    for (let i = 0; i < count; ++i) {
      const guess = before ? before[i]! : i > 0 ? values[i - 1]! : 0;
      values[i] = bytes[time * count + i]! + guess; // modulo 256
    }
    all.push(values);
  }
  return all;
}
