/** Buttons on the map, layers with their legend, the scale, the place under the pointer. */
import { h } from "../../report/dom";
import type { App } from "../app";
import { latLonText, mgrsText, utmText } from "../frames";
import type { Layers, Settings } from "../settings";
import { T } from "../texts";
import { iconButton, labelledField, option, popover, setText } from "../ui";
import type { Here } from "./map_view";

type Group = [title: string, layers: [keyof Layers, string][]];

const kGroups: Group[] = [
  [T.layers.groups.fire, [["belief", "belief"], ["band", "band"], ["sigmas", "sigma"], ["forecasts", "ahead"], ["forecastBands", "aheadband"], ["crossings", "crossing"], ["readings", "reading"], ["truth", "truth"]]],
  [T.layers.groups.air, [["tails", "track"], ["tasks", "plan"], ["safety", "safety"], ["footprints", "footprint"], ["traffic", "traffic"], ["names", ""]]],
  [T.layers.groups.ground, [["terrain", ""], ["zones", "zone"], ["missions", "mission"], ["objects", "object"]]],
];

function layersPanel(app: App): HTMLElement {
  const { settings, map } = app;
  const check = (layer: keyof Layers, key: string) => {
    const box = h("input", { type: "checkbox", checked: settings.layers[layer] === true, onchange: () => {
      (settings.layers[layer] as boolean) = box.checked;
      app.saveSettings();
      map.applyLayers();
    } });
    return h("label", { class: "check" }, box, h("span", { class: `key ${key}`, "aria-hidden": "true" }), T.layers[layer as keyof typeof T.layers] as string);
  };
  const tail = h("select", { onchange: () => { settings.tail = Number(tail.value); app.saveSettings(); map.applyLayers(); } },
    ...[15, 30, 60, 120, 300].map((s) => option(String(s), app.units.seconds(s), s === settings.tail)));
  const horizon = h("select", { onchange: () => { settings.layers.horizon = Number(horizon.value); app.saveSettings(); map.applyLayers(); } },
    option("0", T.layers.allHorizons), ...[10, 30, 60].map((m) => option(String(m), T.layers.minutes(m), m === settings.layers.horizon)));
  const imagery = h("input", { type: "checkbox", checked: settings.imagery, onchange: () => {
    settings.imagery = imagery.checked;
    app.saveSettings();
    map.showImagery();
  } });
  return h("div", { class: "popover layers-panel", role: "group", "aria-label": T.map.layers },
    h("div", { class: "layer-groups" }, ...kGroups.map(([title, layers]) => h("fieldset", {}, h("legend", {}, title), ...layers.map(([layer, key]) => check(layer, key)))),
      h("fieldset", {}, h("legend", {}, T.layers.icons), h("ul", { class: "icon-legend" }, ...Object.entries(T.layers.iconNames).map(([name, text]) =>
        h("li", {}, h("span", { class: `craft ${name}`, "aria-hidden": "true" }), text))))),
    h("div", { class: "row" }, labelledField(T.layers.tail, tail), labelledField(T.layers.horizon, horizon)),
    app.run.imagery ? h("label", { class: "check" }, imagery, T.layers.imagery) : h("p", { class: "hint" }, T.layers.imageryHint));
}

/** The buttons; `keys` are what shortcuts do with them. */
export function mapControls(app: App): { element: HTMLElement; layers: () => void } {
  const { map } = app, gl = map.map;
  const north = iconButton("north", T.map.north, () => gl.easeTo({ bearing: 0, duration: 300 }), { class: "icon-button compass" });
  gl.on("rotate", () => { (north.firstElementChild as SVGElement).style.transform = `rotate(${-gl.getBearing()}deg)`; });
  const follow = iconButton("follow", T.map.follow, () => { map.follow = !map.follow && map.selected.size > 0; });
  const measure = iconButton("measure", T.map.measure, () => app.tools.measure());
  const layersButton = iconButton("layers", T.map.layers, () => undefined);
  const panel = layersPanel(app);
  const { toggle } = popover(layersButton, panel);
  app.every(() => {
    follow.setAttribute("aria-pressed", String(map.follow));
    follow.disabled = map.selected.size === 0;
    measure.setAttribute("aria-pressed", String(app.tools.measuring));
  });
  return {
    element: h("div", { class: "map-controls" },
      h("div", { class: "button-group", role: "group", "aria-label": T.map.zoomIn }, iconButton("plus", T.map.zoomIn, () => gl.zoomIn()),
        iconButton("minus", T.map.zoomOut, () => gl.zoomOut()), north, iconButton("fit", T.map.fit, () => map.fit())),
      h("div", { class: "button-group", role: "group", "aria-label": T.map.follow }, follow, measure),
      h("div", { class: "button-group popover-holder" }, layersButton, panel)),
    layers: toggle,
  };
}

const kForms: Settings["position"][] = ["latlon", "utm", "mgrs", "local"];

/** Scale bar and the place under the pointer. */
export function mapFoot(app: App): HTMLElement {
  const bar = h("span", { class: "scale-bar" }), text = h("span", { class: "scale-text" });
  const where = h("output", { class: "where" });
  const form = h("select", { class: "where-form", "aria-label": T.map.coordinates, onchange: () => {
    app.settings.position = form.value as Settings["position"];
    app.saveSettings();
    show(last);
  } }, ...kForms.map((each) => option(each, T.map.position[each], each === app.settings.position)));
  let last: Here | null = null;
  const show = (here: Here | null) => {
    last = here ?? last;
    if (!last) return;
    const place = app.settings.position === "latlon" ? latLonText(last) : app.settings.position === "utm" ? utmText(last)
      : app.settings.position === "mgrs" ? mgrsText(last) : T.map.local(last.north_m, last.east_m);
    const ground = app.terrain ? `, ${T.map.ground(app.units.height(app.terrain.at(last.north_m, last.east_m)))}` : "";
    setText(where, place + ground);
  };
  app.map.onPointer = show;
  const scale = () => {
    const gl = app.map.map, y = gl.getContainer().clientHeight / 2;
    const a = gl.unproject([0, y]), b = gl.unproject([100, y]);
    const metres = (Math.abs(b.lng - a.lng) * Math.PI * 6378137 * Math.cos((a.lat * Math.PI) / 180)) / 180;
    if (!(metres > 0)) return;
    const { metres: length, text: name } = app.units.bar(metres);
    bar.style.width = `${(100 * length) / metres}px`;
    setText(text, name);
  };
  app.every(scale);
  return h("div", { class: "map-foot" }, h("div", { class: "scale", "aria-hidden": "true" }, text, bar), h("div", { class: "position" }, form, where));
}
