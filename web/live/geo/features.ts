// SPDX-License-Identifier: Apache-2.0
/** Places as other programs keep them: features in the local frame, here and in files. */

export type Ring = [number, number][]; // north and east [m]

/** What a shape is for, as .plan files say; empty: nobody has said. */
export type Purpose = "" | "inclusion" | "exclusion" | "survey" | "corridor" | "route" | "waypoint" | "rally";

export interface Circle {
  north_m: number;
  east_m: number;
  radius_m: number;
}

export interface Feature {
  name: string;
  purpose?: Purpose;
  circle?: Circle | null; // an area that is one
  geometry: { kind: "point"; at: [number, number] } | { kind: "line"; points: Ring } | { kind: "area"; rings: Ring[] };
  properties: Record<string, string | number | boolean | null>;
}
