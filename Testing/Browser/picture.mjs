// SPDX-License-Identifier: Apache-2.0
// Screenshots as numbers.
import { inflateSync } from "node:zlib";

/** A .png of 8-bit RGB or RGBA, not interlaced: width, height, channels, bytes. */
export function decoded(png) {
  let at = 8;
  let width = 0;
  let height = 0;
  let channels = 0;
  const parts = [];
  while (at < png.length) {
    const length = png.readUInt32BE(at);
    const kind = png.toString("latin1", at + 4, at + 8);
    const data = png.subarray(at + 8, at + 8 + length);
    if (kind === "IHDR") {
      width = data.readUInt32BE(0);
      height = data.readUInt32BE(4);
      channels = { 2: 3, 6: 4 }[data[9]];
      if (data[8] !== 8 || !channels || data[12] !== 0) throw new Error("not such a .png");
    }
    if (kind === "IDAT") parts.push(data);
    at += 12 + length;
  }
  return { width, height, channels, bytes: unfiltered(inflateSync(Buffer.concat(parts)), width, height, channels) };
}

// PNG specification, second edition, clause 9.
function unfiltered(raw, width, height, channels) {
  const row = width * channels;
  const out = Buffer.alloc(row * height);
  for (let y = 0; y < height; ++y) {
    const filter = raw[y * (row + 1)];
    for (let x = 0; x < row; ++x) {
      const left = x >= channels ? out[y * row + x - channels] : 0;
      const up = y > 0 ? out[(y - 1) * row + x] : 0;
      const corner = x >= channels && y > 0 ? out[(y - 1) * row + x - channels] : 0;
      const guesses = [0, left, up, (left + up) >> 1, paeth(left, up, corner)];
      out[y * row + x] = raw[y * (row + 1) + 1 + x] + guesses[filter];
    }
  }
  return out;
}

function paeth(a, b, c) {
  const p = a + b - c;
  const [pa, pb, pc] = [Math.abs(p - a), Math.abs(p - b), Math.abs(p - c)];
  return pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
}

/** Share of pixels in which two pictures of one size differ clearly. */
export function difference(one, other) {
  if (one.width !== other.width || one.height !== other.height) return 1;
  let differing = 0;
  for (let i = 0; i < one.width * one.height; ++i) {
    let most = 0;
    for (let c = 0; c < 3; ++c)
      most = Math.max(
        most,
        Math.abs(one.bytes[i * one.channels + c] - other.bytes[i * other.channels + c]),
      );
    differing += most > 24 ? 1 : 0;
  }
  return differing / (one.width * one.height);
}

/** Share of pixels that are not the ground, which is the colour of a corner. */
export function covered(picture) {
  const { width, height, channels, bytes } = picture;
  const ground = Buffer.alloc(bytes.length);
  const at = channels * (4 * width + 4);
  for (let i = 0; i < bytes.length; i += channels) bytes.copy(ground, i, at, at + channels);
  return difference(picture, { width, height, channels, bytes: ground });
}
