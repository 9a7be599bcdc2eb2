// SPDX-License-Identifier: Apache-2.0
// What a plane leaves of a body: whole tetrahedra, so that the cut shows them.

import type { Mesh } from "./unpack";
import { faceCorners } from "./unpack";

/** Points with sign * coordinate > sign * at are before the plane. */
export interface Plane {
  axis: 0 | 1 | 2;
  sign: 1 | -1;
  at: number; // mm
}

/** Triangles to draw, three points each, and the tetrahedron behind each. */
export interface Drawn {
  triangles: Int32Array;
  owners: Int32Array;
}

export interface Opened {
  skin: Drawn; // the body's own surface
  inside: Drawn; // tetrahedra that the plane goes through
}

const nothing: Drawn = { triangles: new Int32Array(0), owners: new Int32Array(0) };

export function isBefore(plane: Plane, coordinate: number): boolean {
  return plane.sign * (coordinate - plane.at) > 0;
}

function chosen(from: Drawn, keep: (owner: number, at: number) => boolean): Drawn {
  const triangles: number[] = [];
  const owners: number[] = [];
  for (let f = 0; f < from.owners.length; ++f) {
    const owner = from.owners[f]!;
    if (!keep(owner, 3 * f)) continue;
    owners.push(owner);
    triangles.push(from.triangles[3 * f]!, from.triangles[3 * f + 1]!, from.triangles[3 * f + 2]!);
  }
  return { triangles: Int32Array.from(triangles), owners: Int32Array.from(owners) };
}

/**
 * A tetrahedron goes when all its corners are before the plane. One that stays with a corner
 * before the plane may have lost a neighbour: all four of its faces are drawn, which closes
 * what is left.
 */
export function opened(mesh: Mesh, x: Float32Array, plane: Plane | null): Opened {
  if (!plane) return { skin: mesh, inside: nothing };
  const before = new Uint8Array(x.length / 3);
  let some = 0;
  for (let i = 0; i < before.length; ++i)
    some += before[i] = isBefore(plane, x[3 * i + plane.axis]!) ? 1 : 0;
  if (some === 0) return { skin: mesh, inside: nothing };
  if (some === before.length) return { skin: nothing, inside: nothing };
  if (mesh.tets.length === 0) {
    const corners = mesh.triangles;
    const stays = (_: number, at: number): boolean =>
      before[corners[at]!]! + before[corners[at + 1]!]! + before[corners[at + 2]!]! < 3;
    return { skin: chosen(mesh, stays), inside: nothing };
  }
  const count = mesh.tets.length / 4;
  const gone = new Uint8Array(count); // corners before the plane
  const triangles: number[] = [];
  const owners: number[] = [];
  for (let t = 0; t < count; ++t) {
    let corners = 0;
    for (let i = 0; i < 4; ++i) corners += before[mesh.tets[4 * t + i]!]!;
    gone[t] = corners;
    if (corners === 0 || corners === 4) continue;
    for (const [i, j, k] of faceCorners) {
      owners.push(t);
      triangles.push(mesh.tets[4 * t + i]!, mesh.tets[4 * t + j]!, mesh.tets[4 * t + k]!);
    }
  }
  return {
    skin: chosen(mesh, (owner) => gone[owner] === 0),
    inside: { triangles: Int32Array.from(triangles), owners: Int32Array.from(owners) },
  };
}
