// SPDX-License-Identifier: Apache-2.0
/** Starts the page: asks what is run, logs in where a token is wanted, puts the parts together. */
import "uplot/dist/uPlot.min.css";
import "./style.css";
import { setWorkerUrl } from "maplibre-gl";
import { h } from "../common/dom";
import { load } from "./app";
import { login } from "./login";
import { build } from "./page";
import type { RunDescription } from "../common/protocol";
import { loadSettings } from "../common/settings";
import { T } from "../common/texts";
import { applyTheme } from "../common/page_controls";
import { button } from "../common/ui";

const root = document.getElementById("page")!;

async function describe(): Promise<RunDescription> {
  for (;;) {
    const response = await fetch("api/run");
    if (response.status === 401) {
      await login(root);
      continue;
    }
    if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
    return (await response.json()) as RunDescription;
  }
}

async function start(): Promise<void> {
  root.replaceChildren(h("main", { class: "start" }, h("p", { role: "status" }, T.start.loading)));
  try {
    const run = await describe();
    document.title = `${run.name} – ${T.name}`;
    const app = await load(run);
    build(app, root);
    app.connection.open();
    document.documentElement.dataset.state = "ready";
    Object.assign(window, { skein: app }); // for tests, and for who looks into it
  } catch (problem) {
    document.documentElement.dataset.state = "failed";
    root.replaceChildren(
      h(
        "main",
        { class: "start" },
        h("p", { class: "problem", role: "alert" }, T.start.failed(problem instanceof Error ? problem.message : String(problem))),
        button(T.start.retry, () => void start(), { class: "primary" }),
      ),
    );
  }
}

setWorkerUrl("worker.js");
applyTheme(loadSettings().theme);
void start();
