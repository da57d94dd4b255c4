/** The page of one run or several. */
import "uplot/dist/uPlot.min.css";
import "./style.css";
import { setWorkerUrl } from "maplibre-gl";
import type { RunsData } from "./data";
import { show } from "./page";
import { runsPage } from "./runs_page";
import { unpackedBlock } from "./unpack";

void show<RunsData>(async ({ title, runs }) => {
  setWorkerUrl(URL.createObjectURL(new Blob([await unpackedBlock("worker")], { type: "text/javascript" })));
  return runsPage(title, runs);
});
