// SPDX-License-Identifier: Apache-2.0
/** What the pages of runs and of studies have in common. */
import { loadSettings } from "../common/settings";
import { applyTheme } from "../common/page_controls";
import type { PageData } from "./data";
import { h } from "../common/dom";

const root = document.getElementById("page")!;

function complain(problem: unknown): void {
  document.documentElement.dataset.state = "failed";
  root.prepend(h("p", { class: "failure", role: "alert" }, `This page could not be shown in full: ${String(problem)}`));
}

/** Builds the page from the data that the program put into it. */
export async function show<D extends PageData>(build: (data: D) => HTMLElement[] | Promise<HTMLElement[]>): Promise<void> {
  window.addEventListener("error", (event) => {
    // Browsers report a size observer that is called again in the same frame: harmless.
    if (!String(event.message).includes("ResizeObserver")) complain(event.message);
  });
  window.addEventListener("unhandledrejection", (event) => complain(event.reason));
  applyTheme(loadSettings().theme);
  try {
    const data = JSON.parse(document.getElementById("data")!.textContent ?? "") as D;
    root.replaceChildren(...(await build(data)), h("footer", {}, "Made by Skein. This file holds all its data and needs no network."));
    document.documentElement.dataset.state ??= "ready";
  } catch (problem) {
    complain(problem);
  }
}
