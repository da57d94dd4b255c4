// SPDX-License-Identifier: Apache-2.0
/** Buttons on the map, layers with their legend, the scale, the place under the pointer. */
import { h } from "../dom";
import { latLonText, mgrsText, utmText } from "../frames";
import type { Layers, Settings } from "../settings";
import { T } from "../texts";
import { iconButton, labelledField, option, popover, setText } from "../ui";
import type { RunView } from "../view";
import type { Here } from "./map_view";

type Group = [title: string, layers: [keyof Layers, string][]];

const kGroups: Group[] = [
  [
    T.layers.groups.fire,
    [
      ["belief", "belief"],
      ["band", "band"],
      ["sigmas", "sigma"],
      ["forecasts", "ahead"],
      ["forecastBands", "aheadband"],
      ["crossings", "crossing"],
      ["readings", "reading"],
      ["truth", "truth"],
    ],
  ],
  [
    T.layers.groups.air,
    [
      ["tails", "tail"],
      ["tracks", "track"],
      ["tasks", "plan"],
      ["safety", "safety"],
      ["footprints", "footprint"],
      ["traffic", "traffic"],
      ["names", ""],
    ],
  ],
  [
    T.layers.groups.ground,
    [
      ["terrain", ""],
      ["zones", "zone"],
      ["missions", "mission"],
      ["objects", "object"],
    ],
  ],
];

function layersPanel(view: RunView): HTMLElement {
  const { settings, map } = view;
  const check = (layer: keyof Layers, key: string) => {
    const box = h("input", {
      type: "checkbox",
      checked: settings.layers[layer] === true,
      onchange: () => {
        (settings.layers[layer] as boolean) = box.checked;
        view.saveSettings();
        map.applyLayers();
      },
    });
    return h("label", { class: "check" }, box, h("span", { class: `key ${key}`, "aria-hidden": "true" }), T.layers[layer as keyof typeof T.layers] as string);
  };
  const tail = h(
    "select",
    {
      onchange: () => {
        settings.tail = Number(tail.value);
        view.saveSettings();
        map.applyLayers();
      },
    },
    ...[15, 30, 60, 120, 300].map((s) => option(String(s), view.units.seconds(s), s === settings.tail)),
  );
  const horizon = h(
    "select",
    {
      onchange: () => {
        settings.layers.horizon = Number(horizon.value);
        view.saveSettings();
        map.applyLayers();
      },
    },
    option("0", T.layers.allHorizons),
    ...[10, 30, 60].map((m) => option(String(m), T.layers.minutes(m), m === settings.layers.horizon)),
  );
  const imagery = h("input", {
    type: "checkbox",
    checked: settings.imagery,
    onchange: () => {
      settings.imagery = imagery.checked;
      view.saveSettings();
      map.showImagery();
    },
  });
  return h(
    "div",
    { class: "popover layers-panel", role: "group", "aria-label": T.map.layers },
    h(
      "div",
      { class: "layer-groups" },
      ...kGroups.map(([title, layers]) => h("fieldset", {}, h("legend", {}, title), ...layers.map(([layer, key]) => check(layer, key)))),
      h(
        "fieldset",
        {},
        h("legend", {}, T.layers.icons),
        h(
          "ul",
          { class: "icon-legend" },
          ...Object.entries(T.layers.iconNames).map(([name, text]) => h("li", {}, h("span", { class: `craft ${name}`, "aria-hidden": "true" }), text)),
        ),
      ),
    ),
    h("div", { class: "row" }, labelledField(T.layers.tail, tail), labelledField(T.layers.horizon, horizon)),
    view.run.imagery
      ? h("label", { class: "check" }, imagery, T.layers.imagery)
      : view.run.imagery === ""
        ? h("p", { class: "hint" }, T.layers.imageryHint)
        : null,
  ); // a file has none
}

/** The buttons; `keys` are what shortcuts do with them. */
export function mapControls(view: RunView): { element: HTMLElement; layers: () => void } {
  const { map } = view,
    gl = map.map;
  const north = iconButton("north", T.map.north, () => gl.easeTo({ bearing: 0, duration: 300 }), { class: "icon-button compass" });
  gl.on("rotate", () => {
    (north.firstElementChild as SVGElement).style.transform = `rotate(${-gl.getBearing()}deg)`;
  });
  const follow = iconButton("follow", T.map.follow, () => {
    map.follow = !map.follow && map.selected.size > 0;
  });
  const measure = iconButton("measure", T.map.measure, () => view.tools.measure());
  const layersButton = iconButton("layers", T.map.layers, () => undefined);
  const panel = layersPanel(view);
  const { toggle } = popover(layersButton, panel);
  view.every(() => {
    follow.setAttribute("aria-pressed", String(map.follow));
    follow.disabled = map.selected.size === 0;
    measure.setAttribute("aria-pressed", String(view.tools.measuring));
  });
  return {
    element: h(
      "div",
      { class: "map-controls" },
      h(
        "div",
        { class: "button-group", role: "group", "aria-label": T.map.zoomIn },
        iconButton("plus", T.map.zoomIn, () => gl.zoomIn()),
        iconButton("minus", T.map.zoomOut, () => gl.zoomOut()),
        north,
        iconButton("fit", T.map.fit, () => map.fit()),
      ),
      h("div", { class: "button-group", role: "group", "aria-label": T.map.follow }, follow, measure),
      h("div", { class: "button-group popover-holder" }, layersButton, panel),
    ),
    layers: toggle,
  };
}

const kForms: Settings["position"][] = ["latlon", "utm", "mgrs", "local"];

/** Scale bar and the place under the pointer. */
export function mapFoot(view: RunView): HTMLElement {
  const bar = h("span", { class: "scale-bar" }),
    text = h("span", { class: "scale-text" });
  const where = h("output", { class: "where" });
  // Of a run whose origin is not known there is only the local place.
  const forms = view.run.origin ? kForms : kForms.slice(-1);
  const form = h(
    "select",
    {
      class: "where-form",
      "aria-label": T.map.coordinates,
      onchange: () => {
        view.settings.position = form.value as Settings["position"];
        view.saveSettings();
        show(last);
      },
    },
    ...forms.map((each) => option(each, T.map.position[each], each === view.settings.position)),
  );
  let last: Here | null = null;
  const show = (here: Here | null) => {
    last = here ?? last;
    if (!last) return;
    const chosen = form.value as Settings["position"];
    const place =
      chosen === "latlon" ? latLonText(last) : chosen === "utm" ? utmText(last) : chosen === "mgrs" ? mgrsText(last) : T.map.local(last.north_m, last.east_m);
    const ground = view.terrain ? `, ${T.map.ground(view.units.height(view.terrain.at(last.north_m, last.east_m)))}` : "";
    setText(where, place + ground);
  };
  view.map.onPointer = show;
  const scale = () => {
    const gl = view.map.map,
      y = gl.getContainer().clientHeight / 2;
    const a = gl.unproject([0, y]),
      b = gl.unproject([100, y]);
    const metres = (Math.abs(b.lng - a.lng) * Math.PI * 6378137 * Math.cos((a.lat * Math.PI) / 180)) / 180;
    if (!(metres > 0)) return;
    const { metres: length, text: name } = view.units.bar(metres);
    bar.style.width = `${(100 * length) / metres}px`;
    setText(text, name);
  };
  view.every(scale);
  return h("div", { class: "map-foot" }, h("div", { class: "scale", "aria-hidden": "true" }, text, bar), h("div", { class: "position" }, form, where));
}
