// SPDX-License-Identifier: Apache-2.0
/** How the aircraft of one run flew, over time. */
import type { ChartOptions, Line } from "../common/chart";
import { floats, type FlightColumn, type RunData } from "./data";

const kPlots: { title: string; note?: string; unit?: string; column: FlightColumn; percent?: boolean }[] = [
  { title: "Altitude", unit: "m", note: "above mean sea level, true", column: "altitude_msl_m" },
  { title: "Airspeed", unit: "m/s", note: "true", column: "airspeed_mps" },
  { title: "Off the path", unit: "m", note: "as the aircraft believe, right positive", column: "cross_track_m" },
  { title: "Error of own position", unit: "m", note: "horizontal: estimate against truth", column: "position_error_m" },
  { title: "Charge", unit: "%", note: "left in battery or tank", column: "charge", percent: true },
  { title: "Reserve", unit: "%", note: "of the charge, less what it takes to get home", column: "reserve", percent: true },
];

/** Plots of what the records hold and what changes: a point mass keeps its charge for ever. */
export function flightCharts(run: RunData): Pick<ChartOptions, "title" | "note" | "unit" | "lines">[] {
  const names = new Map(run.entities.map((entity) => [entity.entity_id, entity.name]));
  return kPlots.map(({ title, note, unit, column, percent }) => {
    const lines: Line[] = run.flights.map((flight, k) => ({
      name: names.get(flight.entity) ?? String(flight.entity),
      x: floats(flight.time_s),
      y: Array.from(floats(flight.columns[column]), (v) => (percent ? 100 * v : v)),
      colour: k % 8,
    }));
    const values = lines.flatMap((line) => Array.from(line.y)).filter((v) => v != null && Number.isFinite(v));
    return { title, note, unit, lines: new Set(values).size > 1 ? lines : [] };
  });
}
