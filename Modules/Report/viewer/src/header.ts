// SPDX-License-Identifier: Apache-2.0
// What the page says of its bodies; Modules/Report/ViewerPack.cpp writes it.

/** First byte and number of bytes in the unpacked data. */
export type Span = [number, number];
export type Triple = [number, number, number];

export interface Limits {
  name: string;
  least: number;
  most: number;
}

/** Values of a quantity, a byte each; 255 is none, 0 to 254 lie between the limits. */
export interface PackedValues {
  quantity: number; // of Header.quantities
  at: "points" | "tets";
  bytes: Span;
  times: number; // 1: they do not change
}

export interface PackedBody {
  name: string;
  colour: string; // #rrggbb
  points: number;
  tets: number; // 0: the body is a surface
  triangles: number; // of a surface, else 0
  least: Triple; // corner of the box that coordinates are parts of
  most: Triple;
  connectivity: Span;
  coordinates: Span;
  moments: number; // times with coordinates of their own; 1: it stays
  values: PackedValues[];
  fibres: { step: number; bytes: Span } | null; // directions in every so many tetrahedra
}

export interface Header {
  bodies: PackedBody[];
  quantities: Limits[];
  times: number[]; // s; empty: nothing moves
  ramp: string[]; // colours from least to most
}
