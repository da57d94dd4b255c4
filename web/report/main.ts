// SPDX-License-Identifier: Apache-2.0
/** The page of one run or several. */
import "uplot/dist/uPlot.min.css";
import "./style.css";
import { setWorkerUrl } from "maplibre-gl";
import type { RunsData } from "./data";
import { show } from "./page";
import { runsPage } from "./runs_page";
import { unpackedBlock } from "./unpack";

void show<RunsData>(async ({ title, runs }) => {
  // By its ending the map takes it for no module: browsers start none of those for a page that is a file.
  setWorkerUrl(`${URL.createObjectURL(new Blob([await unpackedBlock("worker")], { type: "text/javascript" }))}#worker.cjs`);
  return runsPage(title, runs);
});
