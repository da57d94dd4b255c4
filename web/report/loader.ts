// SPDX-License-Identifier: Apache-2.0
/** Unpacks the page's script, which stands in the page, and starts it. */
import { unpackedBlock } from "./unpack";

unpackedBlock("script").then(
  (text) => {
    const script = document.createElement("script");
    script.textContent = text;
    document.body.append(script);
  },
  (problem) => {
    document.documentElement.dataset.state = "failed";
    document.getElementById("page")!.textContent = `This browser cannot unpack the report: ${problem}`;
  },
);
