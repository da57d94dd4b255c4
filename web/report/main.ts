/** Builds the page from the data that the program put into it. */
import "uplot/dist/uPlot.min.css";
import "./style.css";
import type { PageData } from "./data";
import { h } from "./dom";
import { runsPage } from "./runs_page";
import { studyPage } from "./study_page";

const root = document.getElementById("page")!;

function complain(problem: unknown): void {
  document.documentElement.dataset.state = "failed";
  root.prepend(h("p", { class: "failure", role: "alert" }, `This page could not be shown in full: ${String(problem)}`));
}

window.addEventListener("error", (event) => {
  // Browsers report a size observer that is called again in the same frame: harmless.
  if (!String(event.message).includes("ResizeObserver")) complain(event.message);
});

try {
  const data = JSON.parse(document.getElementById("data")!.textContent ?? "") as PageData;
  root.replaceChildren(...(data.page === "study" ? studyPage(data) : runsPage(data.title, data.runs)),
    h("footer", {}, "Made by Skein. This file holds all its data and needs no network."));
  document.documentElement.dataset.state = "ready";
} catch (problem) {
  complain(problem);
}
