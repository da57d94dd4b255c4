// SPDX-License-Identifier: Apache-2.0
/** Drawings of the operator: points, lines, areas, circles, with undo; kept in the browser. */
import {
  TerraDraw,
  TerraDrawCircleMode,
  TerraDrawLineStringMode,
  TerraDrawModeUndoRedo,
  TerraDrawPointMode,
  TerraDrawPolygonMode,
  TerraDrawSelectMode,
  TerraDrawSessionUndoRedo,
  type GeoJSONStoreFeatures,
  type HexColor,
} from "terra-draw";
import { TerraDrawMapLibreGLAdapter } from "terra-draw-maplibre-gl-adapter";
import { onThemeChange, theme } from "../../common/theme";
import type { App } from "../app";
import type { Circle, Feature, Purpose, Ring } from "../geo/features";

export type DrawMode = "select" | "point" | "linestring" | "polygon" | "circle";
type Id = string | number;

/** What was drawn: where, and a circle's middle and radius. */
export interface Drawn extends Feature {
  id: Id;
  circle: Circle | null;
}

export class Drawing {
  mode: DrawMode | null = null;
  chosen: Id | null = null;
  onChange: () => void = () => undefined;
  private draw: TerraDraw | null = null;

  constructor(private readonly app: App) {}

  // Made when it is first used: most who look never draw.
  private start(): TerraDraw {
    if (this.draw) return this.draw;
    const colour = () => theme().mission as HexColor,
      paper = () => theme().paper as HexColor;
    const area = {
      fillColor: colour,
      fillOpacity: 0.15,
      outlineColor: colour,
      outlineWidth: 2.5,
      closingPointColor: paper,
      closingPointOutlineColor: colour,
      closingPointWidth: 6,
      closingPointOutlineWidth: 2,
    };
    const line = {
      lineStringColor: colour,
      lineStringWidth: 3,
      closingPointColor: paper,
      closingPointOutlineColor: colour,
      closingPointWidth: 6,
      closingPointOutlineWidth: 2,
    };
    const point = { pointColor: colour, pointWidth: 7, pointOutlineColor: paper, pointOutlineWidth: 2 };
    const parts = { midpoints: true, draggable: true, deletable: true };
    const feature = { draggable: true, coordinates: parts };
    const draw = new TerraDraw({
      adapter: new TerraDrawMapLibreGLAdapter({ map: this.app.map.map, coordinatePrecision: 9 }),
      undoRedo: { modeLevel: new TerraDrawModeUndoRedo(), sessionLevel: new TerraDrawSessionUndoRedo() },
      modes: [
        new TerraDrawPointMode({ styles: point }),
        new TerraDrawLineStringMode({ styles: line }),
        new TerraDrawPolygonMode({ styles: area }),
        new TerraDrawCircleMode({ styles: { fillColor: colour, fillOpacity: 0.15, outlineColor: colour, outlineWidth: 2.5 } }),
        new TerraDrawSelectMode({
          flags: {
            point: { feature: { draggable: true } },
            linestring: { feature },
            polygon: { feature },
            circle: { feature: { draggable: true, coordinates: { resizable: "center", draggable: true } } },
          },
          styles: {
            selectedPolygonColor: colour,
            selectedPolygonFillOpacity: 0.3,
            selectedPolygonOutlineColor: colour,
            selectedPolygonOutlineWidth: 4,
            selectedLineStringColor: colour,
            selectedLineStringWidth: 5,
            selectedPointColor: colour,
            selectedPointWidth: 9,
            selectionPointColor: paper,
            selectionPointOutlineColor: colour,
            selectionPointWidth: 6,
            selectionPointOutlineWidth: 2,
            midPointColor: paper,
            midPointOutlineColor: colour,
            midPointWidth: 4,
            midPointOutlineWidth: 1.5,
          },
        }),
      ],
    });
    draw.start();
    draw.on("finish", (id, { action, mode }) => {
      this.chosen = id;
      this.onChange();
      // What was drawn is chosen, so that it can be corrected at once; points often come in numbers.
      if (action === "draw" && mode !== "point") window.setTimeout(() => this.choose(id));
    });
    draw.on("change", () => this.onChange());
    draw.on("select", (id) => {
      this.chosen = id;
      this.onChange();
    });
    draw.on("deselect", () => {
      this.chosen = null;
      this.onChange();
    });
    draw.on("history", () => this.onChange());
    onThemeChange(() => {
      if (this.draw) this.set(this.mode);
    });
    this.app.map.clickTakers.unshift(() => this.mode !== null);
    return (this.draw = draw);
  }

  set(mode: DrawMode | null): void {
    const draw = this.start();
    this.mode = mode;
    this.app.tools.stop();
    draw.setMode(mode ?? "static");
    this.onChange();
  }

  undo(): void {
    this.draw?.undo();
    this.onChange();
  }
  redo(): void {
    this.draw?.redo();
    this.onChange();
  }
  get canUndo(): boolean {
    return this.draw?.canUndo() ?? false;
  }
  get canRedo(): boolean {
    return this.draw?.canRedo() ?? false;
  }

  remove(): void {
    if (this.chosen === null || !this.draw?.hasFeature(this.chosen)) return;
    const id = this.chosen;
    if (this.mode === "select") this.draw.deselectFeature(id);
    this.draw.removeFeatures([id]);
    this.chosen = null;
    this.onChange();
  }

  choose(id: Id): void {
    this.start();
    if (this.mode !== "select") this.set("select");
    this.draw?.selectFeature(id);
  }

  private convert(feature: GeoJSONStoreFeatures): Drawn | null {
    const { geometry, properties } = feature,
      { frame } = this.app;
    const place = ([lng, lat]: number[]): [number, number] => {
      const { north_m, east_m } = frame.toLocal({ latitude_deg: lat, longitude_deg: lng });
      return [north_m, east_m];
    };
    const base = { id: feature.id!, name: String(properties.name ?? ""), purpose: String(properties.purpose ?? "") as Purpose, properties: {}, circle: null };
    if (geometry.type === "Point") return { ...base, geometry: { kind: "point", at: place(geometry.coordinates as number[]) } };
    if (geometry.type === "LineString") return { ...base, geometry: { kind: "line", points: (geometry.coordinates as number[][]).map(place) } };
    if (geometry.type !== "Polygon") return null;
    const rings = (geometry.coordinates as number[][][]).map((ring) => ring.slice(0, -1).map(place));
    let circle = null;
    if (properties.mode === "circle") {
      const n = rings[0].length;
      const north_m = rings[0].reduce((sum, p) => sum + p[0], 0) / n,
        east_m = rings[0].reduce((sum, p) => sum + p[1], 0) / n;
      circle = { north_m, east_m, radius_m: rings[0].reduce((sum, p) => sum + Math.hypot(p[0] - north_m, p[1] - east_m), 0) / n };
    }
    return { ...base, circle, geometry: { kind: "area", rings } };
  }

  /** All that was drawn, without the handles of editing. */
  all(): Drawn[] {
    const kinds = new Set(["point", "linestring", "polygon", "circle"]);
    return (this.draw?.getSnapshot() ?? [])
      .filter(({ properties: p }) => kinds.has(String(p.mode)) && !p.midPoint && !p.selectionPoint && !p.closingPoint && !p.currentlyDrawing)
      .flatMap((feature) => this.convert(feature) ?? []);
  }

  drawn(): Drawn | null {
    return this.chosen === null ? null : (this.all().find(({ id }) => id === this.chosen) ?? null);
  }

  /** Adds features; of areas only the outer ring. Returns how many were taken. */
  add(features: Feature[]): number {
    const draw = this.start(),
      { frame } = this.app;
    const round = ([north, east]: [number, number]) => frame.toLngLat(north, east).map((v) => Number(v.toFixed(9))) as [number, number];
    const ring = (points: Ring) => [...points, points[0]].map(round);
    const made = features.flatMap(({ name, geometry, purpose = "", circle }): GeoJSONStoreFeatures[] => {
      const feature = (mode: string, g: unknown, more = {}) =>
        ({ type: "Feature", properties: { mode, name, purpose, ...more }, geometry: g }) as GeoJSONStoreFeatures;
      if (circle && geometry.kind === "area")
        return [feature("circle", { type: "Polygon", coordinates: [ring(geometry.rings[0])] }, { radiusKilometers: circle.radius_m / 1000 })];
      if (geometry.kind === "point") return [feature("point", { type: "Point", coordinates: round(geometry.at) })];
      if (geometry.kind === "line")
        return geometry.points.length > 1 ? [feature("linestring", { type: "LineString", coordinates: geometry.points.map(round) })] : [];
      return geometry.rings[0]?.length > 2 ? [feature("polygon", { type: "Polygon", coordinates: [ring(geometry.rings[0])] })] : [];
    });
    const results = draw.addFeatures(made);
    this.onChange();
    return results.filter(({ valid }) => valid).length;
  }
}
