/** Lays the page out: bar, map, dock with its panels, timeline. */
import { h } from "../report/dom";
import type { App } from "./app";
import { mapControls, mapFoot } from "./map/controls";
import { FleetPanel } from "./panels/fleet";
import type { Panel } from "./panels/panel";
import { T } from "./texts";
import { topBar } from "./top_bar";
import { icon } from "./ui";

export function build(app: App, root: HTMLElement): void {
  const fleet = new FleetPanel(app);
  const panels: [string, Panel][] = [["fleet", fleet]];
  const dock = makeDock(app, panels);
  const dimension = () => app.map.set3d(!app.map.is3d);
  const togglePanels = () => { root.classList.toggle("wide"); };
  const controls = mapControls(app, dimension);
  root.className = "app";
  root.replaceChildren(
    topBar(app, { dimension, help: () => undefined, panels: togglePanels }),
    h("main", { class: "stage" }, app.map.element, controls.element, mapFoot(app), app.tools.hint),
    dock.element);
  app.map.resize();
  app.map.applyLayers();
}

function makeDock(app: App, panels: [string, Panel][]): { element: HTMLElement; show: (name: string) => void } {
  const tabs = panels.map(([name]) => {
    const tab = h("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-controls": `panel-${name}`, "aria-selected": "false", tabindex: -1,
      title: T.tabTitles[name] ?? T.tabs[name], onclick: () => show(name) });
    tab.append(icon(name), h("span", {}, T.tabs[name]));
    return tab;
  });
  const bodies = panels.map(([name, panel]) => h("div", { role: "tabpanel", id: `panel-${name}`, "aria-labelledby": `tab-${name}`, class: "tab-panel", hidden: true }, panel.element));
  let current = -1;
  const show = (name: string, focus = false) => {
    const next = panels.findIndex(([each]) => each === name);
    if (next < 0) return;
    if (current >= 0) {
      tabs[current].setAttribute("aria-selected", "false");
      tabs[current].tabIndex = -1;
      bodies[current].hidden = true;
    }
    current = next;
    tabs[next].setAttribute("aria-selected", "true");
    tabs[next].tabIndex = 0;
    bodies[next].hidden = false;
    panels[next][1].update(performance.now() / 1000);
    if (focus) tabs[next].focus();
  };
  const list = h("div", { role: "tablist", "aria-label": T.dock, class: "tabs", onkeydown: (event) => {
    const { key } = event as KeyboardEvent, step = key === "ArrowRight" ? 1 : key === "ArrowLeft" ? -1 : 0;
    if (step === 0) return;
    event.preventDefault();
    event.stopPropagation();
    show(panels[(current + step + panels.length) % panels.length][0], true);
  } }, ...tabs);
  app.every((wall) => panels[current]?.[1].update(wall));
  app.map.onSelect = () => panels[current]?.[1].update(performance.now() / 1000);
  const element = h("aside", { class: "dock", "aria-label": T.dock }, list, ...bodies);
  show(panels[0][0]);
  return { element, show };
}
