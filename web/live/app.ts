// SPDX-License-Identifier: Apache-2.0
/** What all parts of the operator's page share: the run and its map, the connection, commands, drawings. */
import { Connection, type Sent } from "./connection";
import { Frame } from "../common/frames";
import { Drawing } from "./map/drawing";
import { drawPreview } from "../common/map/paths";
import { Terrain } from "../common/map/terrain";
import { Previews } from "./previews";
import type { RunDescription, What } from "../common/protocol";
import { T } from "../common/texts";
import { RunView } from "../common/view";
import { Decoder, type Table } from "../common/wire";
import { kTable } from "../common/wire_table";
import { World } from "../common/world";

export class App extends RunView {
  readonly speeds = [0.25, 0.5, 1, 2, 4, 10, 20, 50, 0];
  readonly seeksAtOnce = false;
  readonly connection: Connection;
  readonly drawing: Drawing;
  readonly previews: Previews;
  showPanel: (name: string) => void = () => undefined;

  constructor(run: RunDescription, terrain: Terrain | null, frame: Frame) {
    const decoder = new Decoder(kTable as Table);
    super(run, terrain, new World(frame, decoder, kTable));
    const url = new URL("live", location.href);
    url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    url.search = url.hash = "";
    this.connection = new Connection(url.href, decoder, (kind, value) => this.world.take(kind, value));
    this.world.onReply = (reply) => this.connection.reply(reply);
    this.drawing = new Drawing(this);
    this.previews = new Previews(this);
    this.map.extras.push((c, view) => {
      for (const { path } of this.previews.shown.values()) drawPreview(c, view, path);
    });
    this.tools.chosenDrawing = () => {
      const drawn = this.drawing.drawn()?.geometry;
      return drawn?.kind === "line" ? drawn.points : drawn?.kind === "area" ? drawn.rings[0] : null;
    };
    this.connection.beforeOpen = () => this.sameRun();
  }

  // After the server has restarted it may have another run: the page begins anew then.
  private async sameRun(): Promise<boolean> {
    const response = await fetch("api/run");
    if (response.status === 401) location.reload();
    if (!response.ok) return false;
    const { run, protocol } = (await response.json()) as RunDescription;
    if (run !== this.run.run || protocol !== this.run.protocol) location.reload();
    return true;
  }

  // Commands.

  get holds(): boolean {
    return this.world.clients.holder !== 0 && this.world.clients.holder === this.world.clients.you;
  }
  get role() {
    return this.world.clients.clients.find(({ client }) => client === this.world.clients.you)?.role ?? this.run.you.role;
  }
  get mayCommand(): boolean {
    return this.role !== "viewer";
  }
  get mayMoveTime(): boolean {
    return this.mayCommand;
  }

  command(command: Record<string, unknown>, text: string): Sent {
    if (this.world.clients.holder === 0) this.hold(true); // nobody has control: who acts takes it
    return this.connection.send({ command }, text);
  }

  giveTask(aircraft: string, what: Partial<What> & { kind: string }, others: string[] = []): Sent {
    const names = T.task.names[what.kind] ?? what.kind;
    return this.command({ kind: "task", aircraft, what, ...(others.length > 0 ? { others } : {}) }, T.commands.task(aircraft, names));
  }

  pause(paused: boolean): void {
    this.command({ kind: "pause", paused }, paused ? T.commands.pause : T.commands.resume);
  }
  step(steps: number): void {
    this.command({ kind: "step", steps }, T.commands.step(steps));
  }
  speed(factor: number): void {
    this.command({ kind: "speed", factor }, T.commands.speed(factor === 0 ? T.top.fast : `${factor}×`));
  }
  seek(seek_s: number): void {
    this.connection.send({ seek_s }, T.commands.seek(`${Math.round(seek_s)} s`));
  }
  hold(hold: boolean): void {
    this.connection.send({ hold }, hold ? T.commands.hold : T.commands.release);
  }
}

/** Loads what the page needs before it can show anything. */
export async function load(run: RunDescription): Promise<App> {
  const frame = new Frame(run.origin!);
  const terrain = await Terrain.load("api/terrain", frame).catch(() => null);
  return new App(run, terrain, frame);
}
