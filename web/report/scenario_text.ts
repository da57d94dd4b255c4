// SPDX-License-Identifier: Apache-2.0
/** What the comparison needs of a run's scenario, as the program writes it: block style,
 * two spaces a level. */
import type { RunData } from "./data";

/** The lines below a top-level key. */
function block(scenario: string, key: string): string[] {
  const lines = scenario.split("\n");
  const start = lines.findIndex((line) => line.startsWith(`${key}:`));
  if (start < 0) return [];
  const length = lines.slice(start + 1).findIndex((line) => !line.startsWith(" "));
  return lines.slice(start, length < 0 ? undefined : start + 1 + length);
}

/** The estimator or strategy of the first mission that has one; empty when none has. */
export function chosen(scenario: string, role: string): string {
  const lines = block(scenario, "missions");
  const at = lines.findIndex((line) => line.trimStart().startsWith(`${role}:`));
  if (at < 0) return "";
  const direct = lines[at]
    .trim()
    .slice(role.length + 1)
    .trim();
  const kind = direct || (lines[at + 1] ?? "").replace(/^ *kind:/, "").trim();
  return kind.replace(/^"|"$/g, "");
}

/** Whether all runs were about the same fire: equal environment, origin and seed. */
export function sameFire(runs: RunData[]): boolean {
  const fires = runs.map((run) => [run.seed, ...block(run.scenario, "origin"), ...block(run.scenario, "environment")].join("\n"));
  return runs.every((run, i) => run.scenario !== "" && fires[i] === fires[0]);
}
