/** Places as other programs keep them: features in the local frame, here and in files. */

export type Ring = [number, number][]; // north and east [m]

export interface Feature {
  name: string;
  geometry: { kind: "point"; at: [number, number] } | { kind: "line"; points: Ring } | { kind: "area"; rings: Ring[] };
  properties: Record<string, string | number | boolean | null>;
}
