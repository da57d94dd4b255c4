// SPDX-License-Identifier: Apache-2.0
/** The map: camera, ground, the canvases above it, and what the pointer does. */
import { Map as MapLibre, type CameraOptions, type CustomLayerInterface, type GeoJSONSource, type MapMouseEvent } from "maplibre-gl";
import { onThemeChange, theme } from "../theme";
import { h } from "../dom";
import type { RunDescription } from "../protocol";
import type { Settings } from "../settings";
import { T } from "../texts";
import type { World } from "../world";
import { AirLayer } from "./air_layer";
import { drawField } from "./field";
import { Boxes, type FieldView } from "./field_view";
import { Labels, type LabelText } from "./labels";
import { Projector } from "./projector";
import { Shaper } from "./shapes";
import { groundColours, mapStyle, tintRamp } from "./style";
import type { Terrain } from "./terrain";

export interface Here {
  north_m: number;
  east_m: number;
  latitude_deg: number;
  longitude_deg: number;
  x: number; // in the map [px]
  y: number;
}

/** Whoever wants the clicks: picking a place, measuring. Returns whether it takes the click. */
export type ClickTaker = (here: Here, double: boolean) => boolean;

/** Where a map is looked from. */
export type Outlook = Required<Pick<CameraOptions, "center" | "zoom" | "bearing" | "pitch">>;

/** Something that draws on the canvas of what changes slowly. */
export type Extra = (c: CanvasRenderingContext2D, view: FieldView) => void;

const kLabelsEvery = 0.33; // [s]
const kMany = 100; // from so many aircraft on what is slow may be slower

export class MapView {
  readonly element: HTMLElement;
  readonly map: MapLibre;
  /** Takes the map off the page for good. */
  readonly remove: () => void;
  readonly camera = new Projector();
  readonly shaper: Shaper;
  readonly selected = new Set<number>();
  follow = false;
  extras: Extra[] = [];
  clickTakers: ClickTaker[] = [];
  onSelect: () => void = () => undefined;
  onPointer: (here: Here | null) => void = () => undefined;
  onContext: (here: Here) => void = () => undefined;
  /** What changes slowly is drawn again so often [s]. */
  fieldEvery = 0.5;
  labelText: (row: number) => LabelText = () => ({ name: "", line: "", warned: false });
  /** Script time of the last frames that were drawn [ms]. */
  readonly frameTimes = new Float64Array(240);
  frames = 0;
  private readonly air: AirLayer;
  private readonly field: CanvasRenderingContext2D;
  private readonly labels = new Labels();
  private readonly boxes = new Boxes();
  private readonly pose = new Float64Array(4);
  private cameraShown = -1;
  private fieldKey = "";
  private labelsAt = -1;
  private fieldAt = -1;
  private timeShown = -1;
  private fleetShown = -1;
  private zonesShown = "";
  private dirty = true;
  private fresh = true;
  private fitted = false;

  constructor(
    private readonly run: RunDescription,
    private readonly world: World,
    readonly terrain: Terrain | null,
    private readonly settings: Settings,
  ) {
    const holder = h("div", { class: "map-gl" });
    const canvas = (name: string) => h("canvas", { class: `over ${name}`, "aria-hidden": "true" });
    const field = canvas("field"),
      air = canvas("air");
    this.element = h("div", { class: "map-stack" }, holder, field, air);
    this.shaper = new Shaper(world.frame, (north, east) => terrain?.at(north, east) ?? 0);
    if (terrain) world.fleet.groundAt = (north, east) => terrain.at(north, east);
    terrain?.serve();
    this.map = new MapLibre({
      container: holder,
      style: mapStyle(terrain, theme().dark, theme().zone),
      bounds: this.whole(),
      fitBoundsOptions: { padding: 12 },
      attributionControl: false,
      maplibreLogo: false,
      fadeDuration: 0,
      maxPitch: 75,
      dragRotate: true,
      pitchWithRotate: true,
      keyboard: true,
      doubleClickZoom: true,
      renderWorldCopies: false,
      validateStyle: false,
    });
    this.map.getCanvas().setAttribute("aria-label", T.map.label);
    this.map.getCanvas().setAttribute("role", "application");
    this.air = new AirLayer(air, this.labels);
    this.field = field.getContext("2d")!;
    const probe: CustomLayerInterface = {
      id: "camera",
      type: "custom",
      renderingMode: "3d",
      render: (_, { defaultProjectionData }) => {
        const frame = world.frame;
        this.camera.set(defaultProjectionData.mainMatrix as unknown as ArrayLike<number>, frame.mercatorX, frame.mercatorY, frame.mercatorPerMetre);
      },
    };
    // Aircraft and fire are drawn at once, before the ground has come.
    this.map.on("style.load", () => {
      if (!this.map.getLayer(probe.id)) this.map.addLayer(probe);
      this.paint();
      this.applyLayers();
      this.showImagery();
    });
    this.map.on("render", () => {
      if (this.camera.version !== this.cameraShown) this.draw(performance.now() / 1000);
    });
    this.listen();
    const forgetTheme = onThemeChange(() => this.paint());
    const sizes = new ResizeObserver(() => this.resize());
    sizes.observe(this.element);
    let next = 0;
    const loop = () => {
      this.draw(performance.now() / 1000);
      next = requestAnimationFrame(loop);
    };
    next = requestAnimationFrame(loop);
    this.remove = () => {
      cancelAnimationFrame(next);
      forgetTheme();
      sizes.disconnect();
      this.air.lose();
      this.map.remove();
      terrain?.forget();
      this.element.remove();
    };
  }

  private listen(): void {
    const here = (event: MapMouseEvent): Here => ({ ...this.place(event.lngLat.lng, event.lngLat.lat), x: event.point.x, y: event.point.y });
    let lastMove = 0;
    this.map.on("mousemove", (event) => {
      if (performance.now() - lastMove < 40) return;
      lastMove = performance.now();
      this.onPointer(here(event));
      this.map.getCanvas().style.cursor = this.clickTakers.length > 0 ? "crosshair" : this.pick(event.point.x, event.point.y) >= 0 ? "pointer" : "";
    });
    this.map.on("mouseout", () => this.onPointer(null));
    this.map.on("click", (event) => {
      const at = here(event);
      for (const taker of [...this.clickTakers].reverse()) if (taker(at, false)) return;
      const id = this.pick(event.point.x, event.point.y);
      const { shiftKey, ctrlKey } = event.originalEvent;
      if (id < 0) {
        if (!shiftKey && !ctrlKey) this.select([]);
        return;
      }
      if (shiftKey || ctrlKey) this.select(this.selected.has(id) ? [...this.selected].filter((other) => other !== id) : [...this.selected, id]);
      else this.select([id]);
    });
    this.map.on("contextmenu", (event) => this.onContext(here(event)));
    this.map.on("dragstart", () => {
      this.follow = false;
    });
    this.map.on("move", () => {
      this.camera.bearing = (this.map.getBearing() * Math.PI) / 180;
      this.camera.pitch = (this.map.getPitch() * Math.PI) / 180;
    });
  }

  /** The local place of a latitude and longitude. */
  place(lng: number, lat: number): Omit<Here, "x" | "y"> {
    return { ...this.world.frame.toLocal({ latitude_deg: lat, longitude_deg: lng }), latitude_deg: lat, longitude_deg: lng };
  }

  /** The aircraft under a pixel; -1 where there is none. */
  pick(x: number, y: number): number {
    const { fleet, play } = this.world,
      time = play.now(performance.now() / 1000);
    let best = -1,
      least = 18 * 18;
    for (let row = 0; row < fleet.count; ++row) {
      fleet.pose(row, time, this.pose);
      if (!this.camera.project(this.pose[0], this.pose[1], this.pose[2])) continue;
      const d = (this.camera.x - x) ** 2 + (this.camera.y - y) ** 2;
      if (d < least) {
        least = d;
        best = fleet.ids[row];
      }
    }
    return best;
  }

  select(ids: number[]): void {
    this.selected.clear();
    for (const id of ids) this.selected.add(id);
    if (ids.length === 0) this.follow = false;
    this.redraw();
    this.onSelect();
  }

  /** Everything is drawn again with the next frame. */
  redraw(): void {
    this.dirty = true;
    this.fieldKey = "";
    this.labelsAt = -1;
  }

  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    this.camera.width = width;
    this.camera.height = height;
    for (const canvas of [this.air.canvas, this.field.canvas]) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    this.field.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.map.resize();
    if (!this.fitted) this.map.fitBounds(this.whole(), { padding: 12, duration: 0 });
    this.fitted = true;
    this.camera.version++;
    this.redraw();
  }

  private warnedColour(): string {
    return theme().dark ? "#ffab1a" : "#b84a00";
  }

  private paint(): void {
    const colours = theme();
    this.air.setTheme(colours, this.warnedColour());
    this.labels.forget();
    this.redraw();
    if (!this.map.getLayer("ground")) return;
    const ground = groundColours(colours.dark);
    this.map.setPaintProperty("ground", "background-color", ground.ground);
    if (this.terrain) {
      this.map.setPaintProperty("tint", "color-relief-color", tintRamp(this.terrain, ground) as never);
      this.map.setPaintProperty("relief", "hillshade-shadow-color", ground.shadow);
      this.map.setPaintProperty("relief", "hillshade-highlight-color", ground.light);
      this.map.setPaintProperty("relief", "hillshade-accent-color", ground.shadow);
    }
    for (const [layer, property] of [
      ["zones-fill", "fill-color"],
      ["zones-line", "line-color"],
      ["zones-walls", "fill-extrusion-color"],
    ] as const)
      this.map.setPaintProperty(layer, property, colours.zone);
  }

  /** Shows or hides the ground and what hangs on it, as the settings say. */
  applyLayers(): void {
    const { layers, tail } = this.settings;
    this.air.showTails = layers.tails;
    this.air.seconds = tail;
    this.air.showTruth = layers.truth;
    this.air.showRings = layers.safety;
    this.redraw();
    if (!this.map.getLayer("ground")) return;
    const show = (layer: string, shown: boolean) => {
      if (this.map.getLayer(layer)) this.map.setLayoutProperty(layer, "visibility", shown ? "visible" : "none");
    };
    show("tint", layers.terrain);
    show("relief", layers.terrain);
    show("zones-fill", layers.zones);
    show("zones-line", layers.zones);
    show("zones-walls", layers.zones && !this.camera.flat);
  }

  /** Pictures of the ground from where the server's user has said, or none. */
  showImagery(): void {
    const address = this.settings.imagery ? this.run.imagery : "";
    if (this.map.getLayer("tiles")) this.map.removeLayer("tiles");
    if (this.map.getSource("tiles")) this.map.removeSource("tiles");
    if (!address) return;
    this.map.addSource("tiles", { type: "raster", tiles: [address], tileSize: 256 });
    this.map.addLayer({ id: "tiles", type: "raster", source: "tiles" }, this.map.getLayer("relief") ? "relief" : "zones-fill");
  }

  get is3d(): boolean {
    return !this.camera.flat;
  }

  set3d(on: boolean): void {
    this.camera.flat = !on;
    if (this.terrain) this.map.setTerrain(on ? { source: "ground", exaggeration: 1 } : null);
    this.map.easeTo({ pitch: on ? 60 : 0, duration: 600 });
    this.applyLayers();
    this.camera.version++;
    this.map.triggerRepaint();
  }

  /** South-west and north-east of where things happen. */
  private whole(): [[number, number], [number, number]] {
    const { centre, extent_m } = this.run,
      r = extent_m / 2,
      { frame } = this.world;
    return [frame.toLngLat(centre.north_m - r, centre.east_m - r), frame.toLngLat(centre.north_m + r, centre.east_m + r)];
  }

  /** Shows the whole of it. */
  fit(): void {
    this.follow = false;
    this.map.fitBounds(this.whole(), { padding: 12, bearing: this.map.getBearing(), pitch: this.map.getPitch(), duration: 500 });
  }

  // Around the middle of the map, where there is no relief.
  private grid() {
    if (this.terrain && this.settings.layers.terrain) return null;
    const { lng, lat } = this.map.getCenter(),
      { north_m, east_m } = this.place(lng, lat);
    const edge = this.map.unproject([0, this.camera.height / 2]),
      side = this.place(edge.lng, edge.lat);
    const half = Math.max(1, Math.hypot(side.north_m - north_m, side.east_m - east_m));
    this.camera.scale = this.camera.width / 2 / half;
    return { north_m, east_m, half_m: (this.is3d ? 3 : 1.5) * half };
  }

  /** Where it is looked from. */
  get outlook(): Outlook {
    const { map } = this;
    return { center: map.getCenter(), zoom: map.getZoom(), bearing: map.getBearing(), pitch: map.getPitch() };
  }

  /** Looks from there, also before it is seen for the first time. */
  lookFrom(outlook: Outlook): void {
    this.fitted = true;
    this.map.jumpTo(outlook);
  }

  goTo(north: number, east: number): void {
    this.map.easeTo({ center: this.world.frame.toLngLat(north, east), duration: 500 });
  }

  centreOn(id: number): void {
    const row = this.world.fleet.row(id);
    if (row >= 0) this.goTo(this.world.fleet.get(row, "north_m"), this.world.fleet.get(row, "east_m"));
  }

  private setZones(time: number): void {
    const source = this.map.getSource("zones") as GeoJSONSource | undefined;
    const zones = this.world.zonesAt(time),
      shown = zones.map(({ time_s, name }) => `${time_s} ${name}`).join("|");
    if (!source || this.zonesShown === shown) return;
    this.zonesShown = shown;
    const features = zones.flatMap((zone) => {
      const { area } = zone;
      const ring =
        area.kind === "ring"
          ? area.points
          : Array.from({ length: 64 }, (_, k): [number, number] => {
              const a = (k * Math.PI) / 32;
              return [(area.centre_north_m ?? 0) + (area.radius_m ?? 0) * Math.cos(a), (area.centre_east_m ?? 0) + (area.radius_m ?? 0) * Math.sin(a)];
            });
      if (ring.length < 3) return [];
      const coordinates = [...ring, ring[0]].map(([north, east]) => this.world.frame.toLngLat(north, east));
      const ground = this.terrain?.at(ring[0][0], ring[0][1]) ?? 0;
      return [
        {
          type: "Feature" as const,
          geometry: { type: "Polygon" as const, coordinates: [coordinates] },
          properties: {
            name: zone.name,
            base: Math.max(0, (zone.floor_msl_m ?? ground) - ground),
            top: Math.max(20, (zone.ceiling_msl_m ?? ground + 400) - ground),
          },
        },
      ];
    });
    source.setData({ type: "FeatureCollection", features });
  }

  private followNow(time: number): void {
    const id = this.selected.values().next().value;
    const row = id === undefined ? -1 : this.world.fleet.row(id);
    if (row < 0) return;
    this.world.fleet.pose(row, time, this.pose);
    const { mercatorPerMetre, mercatorX, mercatorY } = this.world.frame;
    const x = mercatorX + this.pose[0] * mercatorPerMetre,
      y = mercatorY + this.pose[1] * mercatorPerMetre;
    const lat = (Math.atan(Math.exp((0.5 - y) * 2 * Math.PI)) * 2 - Math.PI / 2) * (180 / Math.PI);
    this.map.jumpTo({ center: [(x - 0.5) * 360, lat] });
  }

  /** The map as it is at this moment. */
  picture(): HTMLCanvasElement {
    const all = document.createElement("canvas"),
      { width, height } = this.air.canvas,
      c = all.getContext("2d")!;
    all.width = width;
    all.height = height;
    // Drawings of graphics cards are there only until the browser has shown them.
    this.redraw();
    this.map.redraw();
    this.draw(performance.now() / 1000);
    for (const canvas of [this.map.getCanvas(), this.field.canvas, this.air.canvas]) c.drawImage(canvas, 0, 0, width, height);
    return all;
  }

  /** Draws what has changed since the last frame. */
  private draw(wall: number): void {
    if (this.camera.version === 0 || this.camera.width <= 1) return;
    const { world, camera } = this,
      begun = performance.now();
    const time = world.play.now(wall);
    this.setZones(time);
    if (this.follow && Math.abs(time - this.timeShown) > 1e-3) this.followNow(time);
    const moved = camera.version !== this.cameraShown;
    const airChanged = moved || this.dirty || Math.abs(time - this.timeShown) > 0.004 || world.fleet.version !== this.fleetShown;
    const v = world.version;
    const due = wall - this.fieldAt > (world.fleet.count > kMany ? 2 : 1) * this.fieldEvery;
    const key = `${v.fire} ${v.forecast} ${v.tracks} ${v.zones} ${v.missions} ${v.objects} ${v.traffic} ${v.alerts} ${v.tasks} ${v.paths} ${v.snapshot} ${v.arrival} ${Math.floor(time)}`;
    if (!airChanged && !(due && key !== this.fieldKey)) return;
    if (moved || this.dirty || (due && key !== this.fieldKey)) {
      const shown = { world, camera, shaper: this.shaper, theme: theme(), layers: this.settings.layers, time, selected: this.selected, grid: this.grid() };
      drawField(this.field, shown, this.boxes);
      for (const extra of this.extras) extra(this.field, shown);
      this.fieldKey = key;
      this.fieldAt = wall;
    }
    if (airChanged) {
      this.air.showTruth = this.settings.layers.truth && world.fleet.time - world.truth.time < 5;
      if (moved ? wall - this.labelsAt > 0.1 : wall - this.labelsAt > kLabelsEvery) {
        this.labels.place(
          world.fleet,
          camera,
          time,
          this.selected,
          this.settings.layers.names ? this.labelText : null,
          theme(),
          this.warnedColour(),
          this.boxes,
        );
        this.labelsAt = wall;
      }
      this.air.draw(world.fleet, world.truth, camera, time);
    }
    this.timeShown = time;
    this.fleetShown = world.fleet.version;
    this.cameraShown = camera.version;
    this.dirty = false;
    if (this.fresh && world.fleet.count > 0) {
      this.fresh = false;
      performance.mark("first picture");
    }
    this.frameTimes[this.frames++ % this.frameTimes.length] = performance.now() - begun;
  }
}
