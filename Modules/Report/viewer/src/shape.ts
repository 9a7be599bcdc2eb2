// SPDX-License-Identifier: Apache-2.0
// The shape of a tetrahedron as Modules/Quality measures it.

export const shapeNames = [
  "smallest dihedral angle, degrees",
  "largest dihedral angle, degrees",
  "aspect ratio",
] as const;

const edges = [
  [0, 1, 2, 3],
  [0, 2, 1, 3],
  [0, 3, 1, 2],
  [1, 2, 0, 3],
  [1, 3, 0, 2],
  [2, 3, 0, 1],
] as const;

/** Smallest and largest dihedral angle, degrees, and longest edge / shortest altitude. */
export function shapesOf(
  tets: Int32Array,
  x: Float32Array,
): [Float32Array, Float32Array, Float32Array] {
  const count = tets.length / 4;
  const smallest = new Float32Array(count);
  const largest = new Float32Array(count);
  const aspect = new Float32Array(count);
  const p = new Float64Array(12);
  const n = new Float64Array(12); // twice the areas' vectors, outward, of faces opposite corners
  for (let t = 0; t < count; ++t) {
    for (let i = 0; i < 4; ++i)
      for (let axis = 0; axis < 3; ++axis)
        p[3 * i + axis] = x[3 * tets[4 * t + i]! + axis]!;
    normal(p, n, 0, 1, 2, 3);
    normal(p, n, 1, 0, 3, 2);
    normal(p, n, 2, 0, 1, 3);
    normal(p, n, 3, 0, 2, 1);
    let least = 180;
    let most = 0;
    let longest = 0;
    for (const [i, j, k, l] of edges) {
      // The angle at edge ij is between the faces that hold it, opposite k and l.
      const cosine = -dot(n, k, l) / Math.sqrt(dot(n, k, k) * dot(n, l, l));
      const angle = (Math.acos(Math.min(1, Math.max(-1, cosine))) * 180) / Math.PI;
      least = Math.min(least, angle);
      most = Math.max(most, angle);
      longest = Math.max(
        longest,
        Math.hypot(p[3 * i]! - p[3 * j]!, p[3 * i + 1]! - p[3 * j + 1]!, p[3 * i + 2]! - p[3 * j + 2]!),
      );
    }
    // An altitude is six volumes by twice the area of its face.
    let sixVolumes = 0;
    for (let axis = 0; axis < 3; ++axis) sixVolumes += n[axis]! * (p[3 + axis]! - p[axis]!);
    let area = 0;
    for (let i = 0; i < 4; ++i) area = Math.max(area, Math.sqrt(dot(n, i, i)));
    smallest[t] = least;
    largest[t] = most;
    aspect[t] = (longest * area) / Math.abs(sixVolumes);
  }
  return [smallest, largest, aspect];
}

function normal(p: Float64Array, n: Float64Array, of: number, a: number, b: number, c: number) {
  const u0 = p[3 * b]! - p[3 * a]!;
  const u1 = p[3 * b + 1]! - p[3 * a + 1]!;
  const u2 = p[3 * b + 2]! - p[3 * a + 2]!;
  const v0 = p[3 * c]! - p[3 * a]!;
  const v1 = p[3 * c + 1]! - p[3 * a + 1]!;
  const v2 = p[3 * c + 2]! - p[3 * a + 2]!;
  n[3 * of] = u1 * v2 - u2 * v1;
  n[3 * of + 1] = u2 * v0 - u0 * v2;
  n[3 * of + 2] = u0 * v1 - u1 * v0;
}

function dot(n: Float64Array, i: number, j: number): number {
  return (
    n[3 * i]! * n[3 * j]! + n[3 * i + 1]! * n[3 * j + 1]! + n[3 * i + 2]! * n[3 * j + 2]!
  );
}
