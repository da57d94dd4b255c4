// SPDX-License-Identifier: Apache-2.0
/** Lays the page out: bar, map, dock with its panels, timeline. */
import { h } from "../common/dom";
import type { App } from "./app";
import { mapControls, mapFoot } from "../common/map/controls";
import { Alerts } from "./alerts";
import { contextMenu } from "../common/context_menu";
import { listenToKeys, showKeys } from "../common/keys";
import { EventsPanel } from "./panels/events";
import { FirePanel } from "./panels/fire";
import { FleetPanel } from "./panels/fleet";
import { InstructorPanel } from "./panels/instructor";
import { LinksPanel } from "./panels/links";
import { MissionPanel } from "./panels/mission";
import type { Panel } from "./panels/panel";
import { PlotsPanel } from "./panels/plots";
import { T } from "../common/texts";
import { Timeline } from "../common/timeline";
import { topBar } from "./top_bar";
import { icon } from "../common/ui";

export function build(app: App, root: HTMLElement): void {
  const fleet = new FleetPanel(app);
  const panels: [string, Panel][] = [
    ["fleet", fleet],
    ["fire", new FirePanel(app)],
    ["mission", new MissionPanel(app)],
    ["events", new EventsPanel(app)],
    ["plots", new PlotsPanel(app)],
    ["links", new LinksPanel(app)],
    ["instructor", new InstructorPanel(app)],
  ];
  const dock = makeDock(app, panels);
  const alerts = new Alerts(app),
    timeline = new Timeline(app),
    toasts = toast(app, alerts);
  const dimension = () => app.map.set3d(!app.map.is3d);
  const showPanel = (name: string) => {
    root.classList.remove("wide");
    dock.show(name);
  };
  const togglePanels = () => {
    root.classList.toggle("wide");
  };
  app.showPanel = showPanel;
  const controls = mapControls(app);
  const stage = h("main", { class: "stage" }, app.map.element, controls.element, alerts.element, mapFoot(app), app.tools.hint, toasts);
  root.className = "app";
  root.replaceChildren(topBar(app, { dimension, help: showKeys, panels: togglePanels }), stage, dock.element, timeline.element);
  contextMenu(app, stage, (place) => {
    const names = [...app.map.selected].map((id) => app.world.name(id));
    const giveAll = (kind: string) => () => {
      for (const name of names) app.giveTask(name, { kind, ...place } as never);
    };
    return app.mayCommand && names.length > 0
      ? [
          [T.map.flyHere(names.join(", ")), giveAll("fly_to")],
          [T.map.orbitHere(names.join(", ")), giveAll("loiter")],
        ]
      : [];
  });
  listenToKeys(
    {
      " ": () => app.pause(!app.world.clock.paused),
      ".": () => app.step(1),
      ...Object.fromEntries(panels.map(([name], k) => [String(k + 1), () => showPanel(name)])),
      j: () => fleet.step(1),
      k: () => fleet.step(-1),
      f: () => {
        app.map.follow = !app.map.follow && app.map.selected.size > 0;
      },
      c: () => {
        for (const id of app.map.selected) return app.map.centreOn(id);
      },
      Home: () => app.map.fit(),
      d: dimension,
      n: () => app.map.map.easeTo({ bearing: 0 }),
      l: () => controls.layers(),
      m: () => app.tools.measure(),
      a: () => alerts.acknowledgeFirst(),
      b: togglePanels,
      "/": () => {
        showPanel("fleet");
        fleet.search.focus();
      },
      "?": showKeys,
      "Ctrl z": () => app.drawing.undo(),
      "Ctrl y": () => app.drawing.redo(),
      Escape: () => (app.drawing.mode ? app.drawing.set(null) : app.map.select([])),
    },
    (event) => app.tools.key(event),
  );
  app.map.resize();
}

/** Short notes about commands that were given here; refusals become alerts. */
function toast(app: App, alerts: Alerts): HTMLElement {
  const element = h("div", { class: "toasts", role: "status", "aria-live": "polite" });
  const shown = new Map<number, HTMLElement>();
  app.connection.onSent = (sent) => {
    let note = shown.get(sent.number);
    if (!note) {
      note = h("div", { class: "toast" });
      shown.set(sent.number, note);
      element.append(note);
      while (element.children.length > 4) element.firstElementChild!.remove();
    }
    note.dataset.state = sent.state;
    note.replaceChildren(h("span", {}, sent.text), h("strong", {}, T.events.states[sent.state]));
    if (sent.state === "refused" || sent.state === "lost") alerts.refuse(sent.text, sent.reason);
    if (sent.state === "pending" || sent.state === "given") return;
    const done = note;
    window.setTimeout(() => {
      done.remove();
      shown.delete(sent.number);
    }, 3500);
  };
  return element;
}

function makeDock(app: App, panels: [string, Panel][]): { element: HTMLElement; show: (name: string) => void } {
  const tabs = panels.map(([name]) => {
    const tab = h("button", {
      type: "button",
      role: "tab",
      id: `tab-${name}`,
      "aria-controls": `panel-${name}`,
      "aria-selected": "false",
      tabindex: -1,
      title: T.tabTitles[name] ?? T.tabs[name],
      onclick: () => show(name),
    });
    tab.append(icon(name), h("span", {}, T.tabs[name]));
    return tab;
  });
  const bodies = panels.map(([name, panel]) =>
    h(
      "div",
      { role: "tabpanel", id: `panel-${name}`, "aria-labelledby": `tab-${name}`, class: "tab-panel", hidden: true },
      h("h2", { class: "visually-hidden" }, T.tabTitles[name] ?? T.tabs[name]),
      panel.element,
    ),
  );
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
  const list = h(
    "div",
    {
      role: "tablist",
      "aria-label": T.dock,
      class: "tabs",
      onkeydown: (event) => {
        const { key } = event as KeyboardEvent,
          step = key === "ArrowRight" ? 1 : key === "ArrowLeft" ? -1 : 0;
        if (step === 0) return;
        event.preventDefault();
        event.stopPropagation();
        show(panels[(current + step + panels.length) % panels.length][0], true);
      },
    },
    ...tabs,
  );
  app.every((wall) => panels[current]?.[1].update(wall));
  app.map.onSelect = () => panels[current]?.[1].update(performance.now() / 1000);
  const element = h("aside", { class: "dock", "aria-label": T.dock }, list, ...bodies);
  show(panels[0][0]);
  return { element, show };
}
