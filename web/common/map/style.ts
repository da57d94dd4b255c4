// SPDX-License-Identifier: Apache-2.0
/** The map below everything that moves: relief from the run's own heights, zones, tiles that the user may add. */
import type { StyleSpecification } from "maplibre-gl";
import type { Terrain } from "./terrain";

export interface GroundColours {
  ground: string;
  tints: string[]; // from the lowest to the highest
  shadow: string;
  light: string;
}

const kLight: GroundColours = { ground: "#e9ebe6", tints: ["#d9e2d3", "#e6e7d6", "#ece5d6", "#e9ded2", "#f3f0ec"], shadow: "#6b7168", light: "#ffffff" };
const kDark: GroundColours = { ground: "#1b1f20", tints: ["#1c2422", "#22292a", "#2a2d2c", "#33322f", "#3f3d3a"], shadow: "#000000", light: "#7f8a88" };

export const groundColours = (dark: boolean) => (dark ? kDark : kLight);

export function tintRamp(terrain: Terrain, colours: GroundColours): unknown[] {
  const span = Math.max(terrain.high - terrain.low, 60),
    n = colours.tints.length - 1;
  return ["interpolate", ["linear"], ["elevation"], ...colours.tints.flatMap((colour, k) => [terrain.low + (span * k) / n, colour])];
}

export function mapStyle(terrain: Terrain | null, dark: boolean, zoneColour: string): StyleSpecification {
  const colours = groundColours(dark);
  const none = { type: "FeatureCollection", features: [] };
  return {
    version: 8,
    transition: { duration: 0, delay: 0 }, // a picture for paper is taken at once
    sources: {
      ...(terrain
        ? {
            heights: {
              type: "raster-dem",
              tiles: [terrain.tiles],
              tileSize: 512,
              encoding: "terrarium",
              maxzoom: terrain.maxZoom(),
              minzoom: 8,
              bounds: terrain.bounds(),
            },
            // A source of its own for the third dimension: the relief's tiles may then be finer.
            ground: {
              type: "raster-dem",
              tiles: [terrain.tiles],
              tileSize: 512,
              encoding: "terrarium",
              maxzoom: terrain.maxZoom(),
              minzoom: 8,
              bounds: terrain.bounds(),
            },
          }
        : {}),
      zones: { type: "geojson", data: none },
    },
    layers: [
      { id: "ground", type: "background", paint: { "background-color": colours.ground } },
      ...(terrain
        ? [
            { id: "tint", type: "color-relief", source: "heights", paint: { "color-relief-color": tintRamp(terrain, colours) } },
            {
              id: "relief",
              type: "hillshade",
              source: "heights",
              paint: {
                "hillshade-exaggeration": dark ? 0.55 : 0.42,
                "hillshade-shadow-color": colours.shadow,
                "hillshade-highlight-color": colours.light,
                "hillshade-accent-color": colours.shadow,
              },
            },
          ]
        : []),
      { id: "zones-fill", type: "fill", source: "zones", paint: { "fill-color": zoneColour, "fill-opacity": 0.13 } },
      { id: "zones-line", type: "line", source: "zones", paint: { "line-color": zoneColour, "line-width": 2 } },
      {
        id: "zones-walls",
        type: "fill-extrusion",
        source: "zones",
        layout: { visibility: "none" },
        paint: {
          "fill-extrusion-color": zoneColour,
          "fill-extrusion-opacity": 0.22,
          "fill-extrusion-base": ["get", "base"],
          "fill-extrusion-height": ["get", "top"],
        },
      },
    ],
  } as unknown as StyleSpecification;
}
