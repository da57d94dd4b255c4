/** GeoJSON (RFC 7946), KML (2.2) and .plan of QGroundControl, written and read. */
import type { Frame } from "../frames";
import type { Feature, Ring } from "./features";

type Position = [number, number, ...number[]];

interface GeoJsonGeometry {
  type: string;
  coordinates?: unknown;
  geometries?: GeoJsonGeometry[];
}

const toPosition = (frame: Frame, [north, east]: [number, number]): Position => {
  const [lng, lat] = frame.toLngLat(north, east);
  return [Number(lng.toFixed(8)), Number(lat.toFixed(8))];
};
const toPlace = (frame: Frame, [lng, lat]: Position): [number, number] => {
  const { north_m, east_m } = frame.toLocal({ latitude_deg: lat, longitude_deg: lng });
  return [north_m, east_m];
};

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

export function toGeoJson(features: Feature[], frame: Frame): string {
  return JSON.stringify({ type: "FeatureCollection", features: features.map(({ name, geometry, properties }) => ({
    type: "Feature",
    properties: { name, ...properties },
    geometry: geometry.kind === "point" ? { type: "Point", coordinates: toPosition(frame, geometry.at) }
      : geometry.kind === "line" ? { type: "LineString", coordinates: geometry.points.map((p) => toPosition(frame, p)) }
        : { type: "Polygon", coordinates: geometry.rings.map((ring, k) => closed(turned(ring.map((p) => toPosition(frame, p)), k > 0))) },
  })) }, null, 1);
}

const escape = (text: string) => text.replace(/[<>&"']/g, (c) => `&#${c.charCodeAt(0)};`);

export function toKml(features: Feature[], frame: Frame): string {
  const list = (ring: Ring, close: boolean) => (close ? closed(ring) : ring).map((p) => toPosition(frame, p).slice(0, 2).join(",")).join(" ");
  const ring = (points: Ring, side: string) => `<${side}><LinearRing><coordinates>${list(points, true)}</coordinates></LinearRing></${side}>`;
  const placemark = ({ name, geometry, properties }: Feature) => `<Placemark><name>${escape(name)}</name><ExtendedData>${
    Object.entries(properties).map(([key, value]) => `<Data name="${escape(key)}"><value>${escape(String(value ?? ""))}</value></Data>`).join("")}</ExtendedData>${
    geometry.kind === "point" ? `<Point><coordinates>${list([geometry.at], false)}</coordinates></Point>`
      : geometry.kind === "line" ? `<LineString><tessellate>1</tessellate><coordinates>${list(geometry.points, false)}</coordinates></LineString>`
        : `<Polygon><tessellate>1</tessellate>${geometry.rings.map((points, k) => ring(points, k === 0 ? "outerBoundaryIs" : "innerBoundaryIs")).join("")}</Polygon>`}</Placemark>`;
  return `<?xml version="1.0" encoding="UTF-8"?>\n<kml xmlns="http://www.opengis.net/kml/2.2"><Document>\n${features.map(placemark).join("\n")}\n</Document></kml>\n`;
}

/** What was read, and how many features were of a kind that is not kept. */
export interface Loaded {
  features: Feature[];
  left: number;
}

const open = (ring: Position[]): Position[] => {
  const first = ring[0], last = ring[ring.length - 1];
  return ring.length > 1 && first[0] === last[0] && first[1] === last[1] ? ring.slice(0, -1) : ring;
};

function geometries(geometry: GeoJsonGeometry | null, frame: Frame): Feature["geometry"][] {
  const place = (p: unknown) => toPlace(frame, p as Position), ring = (r: unknown) => open(r as Position[]).map(place);
  switch (geometry?.type) {
    case "Point": return [{ kind: "point", at: place(geometry.coordinates) }];
    case "MultiPoint": return (geometry.coordinates as unknown[]).map((p) => ({ kind: "point", at: place(p) }));
    case "LineString": return [{ kind: "line", points: (geometry.coordinates as unknown[]).map(place) }];
    case "MultiLineString": return (geometry.coordinates as unknown[][]).map((l) => ({ kind: "line", points: l.map(place) }));
    case "Polygon": return [{ kind: "area", rings: (geometry.coordinates as unknown[]).map(ring) }];
    case "MultiPolygon": return (geometry.coordinates as unknown[][]).map((p) => ({ kind: "area", rings: p.map(ring) }));
    case "GeometryCollection": return (geometry.geometries ?? []).flatMap((each) => geometries(each, frame));
    default: return [];
  }
}

function fromGeoJson(text: string, frame: Frame): Loaded {
  const root = JSON.parse(text) as { type: string; features?: unknown[]; geometry?: unknown };
  const all = (root.type === "FeatureCollection" ? root.features ?? [] : root.type === "Feature" ? [root] : [{ geometry: root, properties: {} }]) as
    { geometry: GeoJsonGeometry | null; properties?: Record<string, unknown> | null }[];
  const loaded: Loaded = { features: [], left: 0 };
  for (const { geometry, properties } of all) {
    const found = geometries(geometry, frame);
    if (found.length === 0) ++loaded.left;
    for (const each of found) loaded.features.push({ name: String(properties?.name ?? ""), geometry: each, properties: {} });
  }
  return loaded;
}

function fromKml(text: string, frame: Frame): Loaded {
  const root = new DOMParser().parseFromString(text, "application/xml");
  if (root.querySelector("parsererror")) throw new Error("this is no XML");
  const list = (element: Element | null): [number, number][] => (element?.textContent ?? "").trim().split(/\s+/).filter(Boolean)
    .map((each) => toPlace(frame, each.split(",").map(Number) as Position));
  const ring = (element: Element) => {
    const points = list(element.querySelector("coordinates"));
    const [a, b] = [points[0], points[points.length - 1]];
    return points.length > 1 && Math.hypot(a[0] - b[0], a[1] - b[1]) < 1e-3 ? points.slice(0, -1) : points;
  };
  const loaded: Loaded = { features: [], left: 0 };
  for (const placemark of root.getElementsByTagName("Placemark")) {
    const name = placemark.getElementsByTagName("name")[0]?.textContent?.trim() ?? "", before = loaded.features.length;
    const add = (geometry: Feature["geometry"]) => loaded.features.push({ name, geometry, properties: {} });
    for (const point of placemark.getElementsByTagName("Point")) add({ kind: "point", at: list(point)[0] });
    for (const line of placemark.getElementsByTagName("LineString")) add({ kind: "line", points: list(line.querySelector("coordinates")) });
    for (const polygon of placemark.getElementsByTagName("Polygon"))
      add({ kind: "area", rings: [...polygon.getElementsByTagName("outerBoundaryIs"), ...polygon.getElementsByTagName("innerBoundaryIs")].map(ring) });
    if (loaded.features.length === before) ++loaded.left;
  }
  return loaded;
}

type LatLng = [number, number];

interface PlanFile {
  fileType: "Plan";
  mission?: { items?: PlanItem[] };
  geoFence?: { polygons?: { polygon: LatLng[]; inclusion?: boolean }[]; circles?: { circle: { center: LatLng; radius: number } }[] };
  rallyPoints?: { points?: number[][] };
}
interface PlanItem {
  type: string;
  command?: number;
  params?: (number | null)[];
  polygon?: LatLng[];
  polyline?: LatLng[];
  items?: PlanItem[];
}

const kWaypoint = 16; // MAV_CMD_NAV_WAYPOINT

/** Waypoints as one line, surveys and fences as areas, rally points as points. */
function fromPlan(plan: PlanFile, frame: Frame): Loaded {
  const loaded: Loaded = { features: [], left: 0 };
  const place = ([lat, lng]: ArrayLike<number> & Iterable<number>) => toPlace(frame, [lng, lat]);
  const add = (name: string, geometry: Feature["geometry"]) => loaded.features.push({ name, geometry, properties: {} });
  const route: [number, number][] = [];
  for (const item of plan.mission?.items ?? []) {
    const lat = item.params?.[4], lng = item.params?.[5];
    if (item.polygon) add("survey", { kind: "area", rings: [item.polygon.map(place)] });
    else if (item.polyline) add("corridor", { kind: "line", points: item.polyline.map(place) });
    else if (item.command === kWaypoint && lat != null && lng != null) route.push(place([lat, lng]));
    else ++loaded.left;
  }
  if (route.length > 1) add("route", { kind: "line", points: route });
  else if (route.length === 1) add("waypoint", { kind: "point", at: route[0] });
  for (const { polygon } of plan.geoFence?.polygons ?? []) add("fence", { kind: "area", rings: [polygon.map(place)] });
  for (const { circle } of plan.geoFence?.circles ?? []) {
    const [north, east] = place(circle.center);
    add("fence", { kind: "area", rings: [Array.from({ length: 64 }, (_, k): [number, number] =>
      [north + circle.radius * Math.cos((k * Math.PI) / 32), east + circle.radius * Math.sin((k * Math.PI) / 32)])] });
  }
  for (const point of plan.rallyPoints?.points ?? []) add("rally point", { kind: "point", at: place(point) });
  return loaded;
}

const toLatLng = (frame: Frame, place: [number, number]): LatLng => {
  const [lng, lat] = toPosition(frame, place);
  return [lat, lng];
};

const kRelativeAltitude = 1, kGlobalRelativeAlt = 3; // heights count from home: of the plan, of MAV_FRAME

/** A mission of QGroundControl: lines and points are flown in their order, at one height over home; areas become fences to stay in. */
export function toPlan(features: Feature[], frame: Frame, height_m: number): string {
  const route = features.flatMap(({ geometry }) => (geometry.kind === "point" ? [geometry.at] : geometry.kind === "line" ? geometry.points : []));
  const areas = features.flatMap(({ geometry }) => (geometry.kind === "area" ? [geometry.rings[0]] : []));
  const home = toLatLng(frame, route[0] ?? areas[0]?.[0] ?? [0, 0]);
  return JSON.stringify({
    fileType: "Plan", groundStation: "Skein", version: 1,
    mission: {
      version: 2, firmwareType: 0, vehicleType: 0, cruiseSpeed: 15, hoverSpeed: 5, globalPlanAltitudeMode: kRelativeAltitude,
      plannedHomePosition: [...home, 0],
      items: route.map((place, i) => ({ type: "SimpleItem", command: kWaypoint, frame: kGlobalRelativeAlt, autoContinue: true, doJumpId: i + 1,
        Altitude: height_m, AltitudeMode: kRelativeAltitude, AMSLAltAboveTerrain: null, params: [0, 0, 0, null, ...toLatLng(frame, place), height_m] })),
    },
    geoFence: { version: 2, circles: [], polygons: areas.map((ring) => ({ version: 1, inclusion: true, polygon: ring.map((place) => toLatLng(frame, place)) })) },
    rallyPoints: { version: 2, points: [] },
  }, null, 1);
}

function fromJson(text: string, frame: Frame): Loaded {
  return (JSON.parse(text) as { fileType?: string }).fileType === "Plan" ? fromPlan(JSON.parse(text) as PlanFile, frame) : fromGeoJson(text, frame);
}

/** Throws where a file is none of them. */
export function readFeatures(text: string, frame: Frame): Loaded {
  const loaded = text.trimStart().startsWith("<") ? fromKml(text, frame) : fromJson(text, frame);
  const numbers = (f: Feature) => (f.geometry.kind === "point" ? [f.geometry.at] : f.geometry.kind === "line" ? f.geometry.points : f.geometry.rings.flat()).flat();
  const good = loaded.features.filter((f) => numbers(f).every(Number.isFinite));
  return { features: good, left: loaded.left + loaded.features.length - good.length };
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
