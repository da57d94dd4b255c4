// SPDX-License-Identifier: Apache-2.0
/** GeoJSON (RFC 7946), KML (2.2) and .plan of QGroundControl: written here, read by the server. */
import type { Frame } from "../../common/frames";
import { cutArea, cutLine, type LngLat } from "./antimeridian";
import type { Circle, Feature, Purpose, Ring } from "./features";

type Position = [number, number, ...number[]];

const rounded = ([lng, lat]: LngLat): Position => [Number(lng.toFixed(8)), Number(lat.toFixed(8))];
const toPosition = (frame: Frame, [north, east]: [number, number]): Position => rounded(frame.toLngLat(north, east));

const closed = <P>(ring: P[]): P[] => (ring.length > 0 ? [...ring, ring[0]] : ring);

/** Rings that run as RFC 7946 wants them: the first against the clock, holes with it. */
function turned(ring: Position[], hole: boolean): Position[] {
  let area = 0;
  ring.forEach(([x, y], i) => {
    const [x2, y2] = ring[(i + 1) % ring.length];
    area += x * y2 - x2 * y;
  });
  return area < 0 === hole ? ring : [...ring].reverse();
}

// What a shape is for goes along; nothing is said of one of which nobody has said it.
const said = ({ purpose, properties }: Feature): Feature["properties"] => (purpose ? { purpose, ...properties } : properties);

/** A line or an area, or several where it crosses 180 degrees of longitude. */
function lineGeometry(points: Ring, frame: Frame) {
  const lines = cutLine(points, frame).map((part) => part.map(rounded));
  return lines.length === 1 ? { type: "LineString", coordinates: lines[0] } : { type: "MultiLineString", coordinates: lines };
}

function areaGeometry(rings: Ring[], frame: Frame) {
  const polygons = cutArea(rings, frame).map((polygon) => polygon.map((ring, k) => closed(turned(ring.map(rounded), k > 0))));
  return polygons.length === 1 ? { type: "Polygon", coordinates: polygons[0] } : { type: "MultiPolygon", coordinates: polygons };
}

export function toGeoJson(features: Feature[], frame: Frame): string {
  const written = features.map((each) => {
    const { name, geometry } = each;
    return {
      type: "Feature",
      properties: { name, ...said(each) },
      geometry:
        geometry.kind === "point"
          ? { type: "Point", coordinates: toPosition(frame, geometry.at) }
          : geometry.kind === "line"
            ? lineGeometry(geometry.points, frame)
            : areaGeometry(geometry.rings, frame),
    };
  });
  return JSON.stringify({ type: "FeatureCollection", features: written }, null, 1);
}

const escape = (text: string) => text.replace(/[<>&"']/g, (c) => `&#${c.charCodeAt(0)};`);

export function toKml(features: Feature[], frame: Frame): string {
  const list = (ring: Ring, close: boolean) => (close ? closed(ring) : ring).map((p) => toPosition(frame, p).slice(0, 2).join(",")).join(" ");
  const ring = (points: Ring, side: string) => `<${side}><LinearRing><coordinates>${list(points, true)}</coordinates></LinearRing></${side}>`;
  const placemark = ({ name, geometry, properties }: Feature) =>
    `<Placemark><name>${escape(name)}</name><ExtendedData>${Object.entries(properties)
      .map(([key, value]) => `<Data name="${escape(key)}"><value>${escape(String(value ?? ""))}</value></Data>`)
      .join("")}</ExtendedData>${
      geometry.kind === "point"
        ? `<Point><coordinates>${list([geometry.at], false)}</coordinates></Point>`
        : geometry.kind === "line"
          ? `<LineString><tessellate>1</tessellate><coordinates>${list(geometry.points, false)}</coordinates></LineString>`
          : `<Polygon><tessellate>1</tessellate>${geometry.rings.map((points, k) => ring(points, k === 0 ? "outerBoundaryIs" : "innerBoundaryIs")).join("")}</Polygon>`
    }</Placemark>`;
  return `<?xml version="1.0" encoding="UTF-8"?>\n<kml xmlns="http://www.opengis.net/kml/2.2"><Document>\n${features.map((each) => placemark({ ...each, properties: said(each) })).join("\n")}\n</Document></kml>\n`;
}

/** What the server answers for a file: see src/skein/assemble/serve/drawing_files.h. */
interface SentFeature {
  name: string;
  purpose: Purpose;
  kind: "point" | "line" | "area" | "circle";
  rings: Ring[];
  radius_m: number | null;
}
export interface Loaded {
  features: Feature[];
  notes: string[];
}

const kCorners = 64; // of a circle that is drawn

function ringOf({ north_m, east_m, radius_m }: Circle): Ring {
  return Array.from({ length: kCorners }, (_, k): [number, number] => [
    north_m + radius_m * Math.cos((2 * k * Math.PI) / kCorners),
    east_m + radius_m * Math.sin((2 * k * Math.PI) / kCorners),
  ]);
}

export function fromServer(sent: SentFeature[]): Feature[] {
  return sent.map(({ name, purpose, kind, rings, radius_m }): Feature => {
    const base = { name, purpose, properties: {} },
      [first] = rings;
    if (kind === "point") return { ...base, geometry: { kind, at: first[0] } };
    if (kind === "line") return { ...base, geometry: { kind, points: first } };
    if (kind === "area") return { ...base, geometry: { kind, rings } };
    const circle = { north_m: first[0][0], east_m: first[0][1], radius_m: radius_m! };
    return { ...base, circle, geometry: { kind: "area", rings: [ringOf(circle)] } };
  });
}

export const kMaxFile = 4 << 20; // that the server takes [bytes]

/** Has the server read a file, with the readers of the command line. Throws what is wrong with it, for people. */
export async function readFeatures(file: File): Promise<Loaded> {
  const response = await fetch(`api/drawings?name=${encodeURIComponent(file.name)}`, {
    method: "POST",
    headers: { "Content-Type": "application/octet-stream" },
    body: file,
  });
  const reply = (await response.json()) as { features?: SentFeature[]; notes?: string[]; error?: string };
  if (!response.ok || !reply.features) throw new Error(reply.error ?? response.statusText);
  return { features: fromServer(reply.features), notes: reply.notes ?? [] };
}

type LatLng = [number, number];

const kWaypoint = 16; // MAV_CMD_NAV_WAYPOINT

const toLatLng = (frame: Frame, place: [number, number]): LatLng => {
  const [lng, lat] = toPosition(frame, place);
  return [lat, lng];
};

const kRelativeAltitude = 1,
  kGlobalRelativeAlt = 3; // heights count from home: of the plan, of MAV_FRAME

/** Whether a .plan of Skein's has room for a feature: surveys and corridors would need what QGroundControl adds to them. */
const isFlown = ({ purpose = "", geometry }: Feature) => geometry.kind !== "area" && (purpose === "" || purpose === "route" || purpose === "waypoint");
const isFence = ({ purpose = "", geometry }: Feature) => geometry.kind === "area" && (purpose === "" || purpose === "inclusion" || purpose === "exclusion");
const isRally = ({ purpose, geometry }: Feature) => geometry.kind === "point" && purpose === "rally";

/** How many features toPlan() leaves out. */
export const leftOutOfPlan = (features: Feature[]) => features.filter((each) => !isFlown(each) && !isFence(each) && !isRally(each)).length;

/**
 * A mission of QGroundControl: lines and points are flown in their order, at one height over home. Areas are fences as they were loaded; one that
 * was drawn is to stay in. Rally points stay such; surveys and corridors are left out.
 */
export function toPlan(features: Feature[], frame: Frame, height_m: number): string {
  const route = features
    .filter(isFlown)
    .flatMap(({ geometry }) => (geometry.kind === "point" ? [geometry.at] : geometry.kind === "line" ? geometry.points : []));
  const fences = features
    .filter(isFence)
    .map(({ geometry, circle, purpose }) => ({ ring: geometry.kind === "area" ? geometry.rings[0] : [], circle, inclusion: purpose !== "exclusion" }));
  const rally = features.filter(isRally).flatMap(({ geometry }) => (geometry.kind === "point" ? [geometry.at] : []));
  const home = toLatLng(frame, route[0] ?? fences[0]?.ring[0] ?? rally[0] ?? [0, 0]);
  return JSON.stringify(
    {
      fileType: "Plan",
      groundStation: "Skein",
      version: 1,
      mission: {
        version: 2,
        firmwareType: 0,
        vehicleType: 0,
        cruiseSpeed: 15,
        hoverSpeed: 5,
        globalPlanAltitudeMode: kRelativeAltitude,
        plannedHomePosition: [...home, 0],
        items: route.map((place, i) => ({
          type: "SimpleItem",
          command: kWaypoint,
          frame: kGlobalRelativeAlt,
          autoContinue: true,
          doJumpId: i + 1,
          Altitude: height_m,
          AltitudeMode: kRelativeAltitude,
          AMSLAltAboveTerrain: null,
          params: [0, 0, 0, null, ...toLatLng(frame, place), height_m],
        })),
      },
      geoFence: {
        version: 2,
        circles: fences.flatMap(({ circle, inclusion }) =>
          circle ? [{ version: 1, inclusion, circle: { center: toLatLng(frame, [circle.north_m, circle.east_m]), radius: circle.radius_m } }] : [],
        ),
        polygons: fences.flatMap(({ ring, circle, inclusion }) =>
          circle ? [] : [{ version: 1, inclusion, polygon: ring.map((place) => toLatLng(frame, place)) }],
        ),
      },
      rallyPoints: { version: 2, points: rally.map((place) => [...toLatLng(frame, place), height_m]) },
    },
    null,
    1,
  );
}

function save(text: string, type: string, name: string): void {
  const url = URL.createObjectURL(new Blob([text], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

export const saveGeoJson = (features: Feature[], frame: Frame, name: string) => save(toGeoJson(features, frame), "application/geo+json", `${name}.geojson`);
export const savePlan = (features: Feature[], frame: Frame, height_m: number, name: string) =>
  save(toPlan(features, frame, height_m), "application/json", `${name}.plan`);
export const saveKml = (features: Feature[], frame: Frame, name: string) => save(toKml(features, frame), "application/vnd.google-earth.kml+xml", `${name}.kml`);
