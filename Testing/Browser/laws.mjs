// SPDX-License-Identifier: Apache-2.0
// What holds of the viewer's own arithmetic, without a browser.
//
//   node laws.mjs VIEWER_BUILD_FOLDER
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { join } from "node:path";

const viewer = process.argv[2];
const { buildSync } = createRequire(join(viewer, "package.json"))("esbuild");
const { outputFiles } = buildSync({
  stdin: {
    contents: ["cut", "shape", "camera", "unpack"].map((m) => `export * from "./src/${m}"`).join("\n"),
    resolveDir: viewer,
  },
  bundle: true,
  format: "esm",
  write: false,
});
const { opened, shapesOf, sideOf, readTets, faceCorners } = await import(
  `data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`
);

// Cubes of five tetrahedra, their outer faces found by counting.
function block(n) {
  const node = (i, j, k) => i + (n + 1) * (j + (n + 1) * k);
  const x = [];
  for (let k = 0; k <= n; ++k)
    for (let j = 0; j <= n; ++j) for (let i = 0; i <= n; ++i) x.push(i, j, k);
  const five = [[0, 1, 2, 4], [3, 2, 1, 7], [5, 4, 7, 1], [6, 7, 4, 2], [1, 2, 4, 7]];
  const tets = [];
  for (let k = 0; k < n; ++k)
    for (let j = 0; j < n; ++j)
      for (let i = 0; i < n; ++i) {
        const odd = (i + j + k) % 2;
        for (const tet of five) {
          const c = tet.map((b) => node(i + ((b & 1) ^ odd), j + ((b >> 1) & 1), k + (b >> 2)));
          tets.push(...(odd ? [c[1], c[0], c[2], c[3]] : c));
        }
      }
  const seen = new Map();
  for (let t = 0; t < tets.length / 4; ++t)
    for (const face of faceCorners) {
      const corners = face.map((i) => tets[4 * t + i]);
      const key = keyOf(corners);
      seen.set(key, seen.has(key) ? null : { corners, t });
    }
  const outer = [...seen.values()].filter(Boolean);
  return {
    x: Float32Array.from(x),
    mesh: {
      tets: Int32Array.from(tets),
      triangles: Int32Array.from(outer.flatMap((face) => face.corners)),
      owners: Int32Array.from(outer.map((face) => face.t)),
    },
  };
}

const keyOf = (corners) => [...corners].sort((a, b) => a - b).join();

// Faces of the tetrahedra that stay, which none that stays covers, are drawn; of those that go
// nothing is.
function cutsShowAllThatStays() {
  const { x, mesh } = block(4);
  const count = mesh.tets.length / 4;
  for (const axis of [0, 1, 2])
    for (const sign of [1, -1])
      for (const at of [0.5, 1.3, 2, 2.7, 3.5]) {
        const stays = (t) =>
          [0, 1, 2, 3].some((i) => sign * (x[3 * mesh.tets[4 * t + i] + axis] - at) <= 0);
        const uncovered = new Set();
        for (let t = 0; t < count; ++t)
          for (const face of stays(t) ? faceCorners : []) {
            const key = keyOf(face.map((i) => mesh.tets[4 * t + i]));
            if (!uncovered.delete(key)) uncovered.add(key);
          }
        const { skin, inside } = opened(mesh, x, { axis, sign, at });
        const drawn = new Set();
        for (const { triangles, owners } of [skin, inside])
          owners.forEach((owner, f) => {
            assert.ok(stays(owner), "a face of what is gone is drawn");
            drawn.add(keyOf(triangles.slice(3 * f, 3 * f + 3)));
          });
        assert.ok(uncovered.size > 0 && inside.owners.length > 0);
        for (const key of uncovered) assert.ok(drawn.has(key), `the face ${key} is missing`);
      }
  const beyond = { axis: 0, sign: 1, at: -1 };
  assert.equal(opened(mesh, x, beyond).skin.owners.length, 0);
  assert.equal(opened(mesh, x, { ...beyond, at: 9 }).skin, mesh);
}

function shapesAreThoseOfKnownTetrahedra() {
  const regular = Float32Array.from([1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1]);
  const corner = Float32Array.from([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]);
  const near = (found, wanted) => assert.ok(Math.abs(found - wanted) < 1e-4, `${found}, ${wanted}`);
  const [least, most, aspect] = shapesOf(Int32Array.from([0, 1, 2, 3]), regular);
  near(least[0], (Math.acos(1 / 3) * 180) / Math.PI);
  near(most[0], least[0]);
  near(aspect[0], Math.sqrt(1.5));
  const [a, b, c] = shapesOf(Int32Array.from([0, 1, 2, 3]), corner);
  near(a[0], (Math.acos(1 / Math.sqrt(3)) * 180) / Math.PI);
  near(b[0], 90);
  near(c[0], Math.sqrt(2) * Math.sqrt(3)); // altitude 1 / sqrt(3) on the slanting face
}

function sidesAreThePatients() {
  assert.equal(sideOf([1, 0, 0]), "L");
  assert.equal(sideOf([0, 1, 0]), "P");
  assert.equal(sideOf([0, 0, -1]), "I");
  assert.equal(sideOf([-0.6, -0.8, 0]), "AR");
}

// Two tetrahedra that share a face, then one apart, as TetCode tells them.
function numbersBecomeTetrahedra() {
  const bytes = Uint8Array.from([2, 2, 2, 2, 2, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 1, 1, 1, 1]);
  const body = { tets: 3, points: 9 };
  const { tets, triangles, parents } = readTets(body, bytes);
  assert.deepEqual([...tets], [0, 1, 2, 3, 1, 2, 3, 4, 5, 6, 7, 8]);
  assert.equal(triangles.length / 3, 10);
  assert.deepEqual([...parents.slice(16, 20)], [1, 2, 3, 0]);
}

cutsShowAllThatStays();
shapesAreThoseOfKnownTetrahedra();
sidesAreThePatients();
numbersBecomeTetrahedra();
