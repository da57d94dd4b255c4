// SPDX-License-Identifier: Apache-2.0
/** What this viewer has chosen; kept in the browser, never sent. */
import type { ThemeChoice } from "./theme";

export interface Layers {
  terrain: boolean;
  truth: boolean;
  belief: boolean;
  band: boolean;
  sigmas: boolean;
  forecasts: boolean;
  forecastBands: boolean;
  horizon: number; // minutes; 0: all
  crossings: boolean;
  readings: boolean;
  tails: boolean;
  tracks: boolean;
  tasks: boolean;
  paths: boolean;
  safety: boolean;
  footprints: boolean;
  objects: boolean;
  traffic: boolean;
  missions: boolean;
  zones: boolean;
  names: boolean;
}

export interface Settings {
  theme: ThemeChoice;
  units: "metric" | "aviation"; // m and m/s, or ft and kt
  sound: boolean;
  tail: number; // [s]
  imagery: boolean; // pictures of the ground are shown, where the server has any
  layers: Layers;
  position: "latlon" | "utm" | "mgrs" | "local";
}

const kKey = "skein.page";

const kDefaults: Settings = {
  theme: "auto",
  units: "metric",
  sound: true,
  tail: 120,
  imagery: true,
  position: "latlon",
  layers: {
    terrain: true,
    truth: true,
    belief: true,
    band: true,
    sigmas: true,
    forecasts: true,
    forecastBands: false,
    horizon: 0,
    crossings: true,
    readings: true,
    tails: true,
    tracks: false,
    tasks: true,
    paths: true,
    safety: true,
    footprints: true,
    objects: true,
    traffic: true,
    missions: true,
    zones: true,
    names: true,
  },
};

export function loadSettings(): Settings {
  const settings: Settings = { ...kDefaults, layers: { ...kDefaults.layers } };
  try {
    const kept = JSON.parse(localStorage.getItem(kKey) ?? "{}") as Partial<Settings>;
    Object.assign(settings, kept, { layers: { ...settings.layers, ...kept.layers } });
  } catch {
    // What was kept makes no sense, or may not be kept: the defaults are good.
  }
  return settings;
}

export function saveSettings(settings: Settings): void {
  try {
    localStorage.setItem(kKey, JSON.stringify(settings));
  } catch {
    // Not kept: the choice holds until the page is closed.
  }
}
