/** What all parts of the page share: the run, the world, the connection, the map, commands. */
import { Connection, type Sent } from "./connection";
import { Frame } from "./frames";
import { Drawing } from "./map/drawing";
import { MapView } from "./map/map_view";
import { drawPreview } from "./map/paths";
import { MapTools } from "./map/tools";
import { Terrain } from "./map/terrain";
import { Previews } from "./previews";
import type { RunDescription, What } from "./protocol";
import { loadSettings, saveSettings, type Settings } from "./settings";
import { T } from "./texts";
import { Units } from "./units";
import { Decoder, type Table } from "./wire";
import { kTable } from "./wire_table";
import { World, type KeptEvent } from "./world";

export class App {
  readonly settings: Settings = loadSettings();
  readonly units = new Units(this.settings);
  readonly frame: Frame;
  readonly world: World;
  readonly connection: Connection;
  readonly map: MapView;
  readonly tools: MapTools;
  readonly drawing: Drawing;
  readonly previews: Previews;
  showPanel: (name: string) => void = () => undefined;
  /** Called a few times a second for parts that show numbers. */
  private readonly tickers: ((wall: number) => void)[] = [];
  private readonly kinds = new Map<string, { hovers: boolean; radius: number }>();

  constructor(readonly run: RunDescription, readonly terrain: Terrain | null, frame: Frame) {
    this.frame = frame;
    const decoder = new Decoder(kTable as Table);
    this.world = new World(frame, decoder, kTable);
    const url = new URL("live", location.href);
    url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    url.search = url.hash = "";
    this.connection = new Connection(url.href, decoder, (kind, value) => this.world.take(kind, value));
    this.world.onReply = (reply) => this.connection.reply(reply);
    for (const { name, kind, hovers, safety_radius_m } of run.aircraft)
      this.kinds.set(name, { hovers: hovers ?? /copter|quad|hexa|rotor|multi/i.test(kind), radius: safety_radius_m ?? 0 });
    this.map = new MapView(run, this.world, terrain, this.settings);
    this.tools = new MapTools(this, this.map);
    this.drawing = new Drawing(this);
    this.previews = new Previews(this);
    this.map.extras.push((c, view) => {
      for (const { path } of this.previews.shown.values()) drawPreview(c, view, path);
    });
    this.tools.chosenDrawing = () => {
      const drawn = this.drawing.drawn()?.geometry;
      return drawn?.kind === "line" ? drawn.points : drawn?.kind === "area" ? drawn.rings[0] : null;
    };
    this.map.labelText = (row) => this.label(row);
    this.connection.beforeOpen = () => this.sameRun();
    window.setInterval(() => this.tick(), 250);
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

  every(ticker: (wall: number) => void): void {
    this.tickers.push(ticker);
  }

  private tick(): void {
    this.dress();
    const wall = performance.now() / 1000;
    for (const ticker of this.tickers) ticker(wall);
  }

  saveSettings(): void {
    saveSettings(this.settings);
  }

  // Icons by kind and reality, safety zones: they follow from what is known of the entity.
  private dressed = -1;
  private dressedCount = -1;
  private dress(): void {
    const { fleet, truth, entities, version } = this.world;
    if (this.dressed === version.entities && this.dressedCount === fleet.count + truth.count) return;
    this.dressed = version.entities;
    this.dressedCount = fleet.count + truth.count;
    for (const each of [fleet, truth])
      for (let row = 0; row < each.count; ++row) {
        const entity = entities.get(each.ids[row]), kind = this.kinds.get(entity?.name ?? "");
        const reality = this.reality(each.ids[row]);
        each.motion[row * 16 + 10] = (reality === "real" ? 8 : reality === "outside simulator" ? 4 : 0) + (kind?.hovers ? 1 : 0);
        each.motion[row * 16 + 14] = each === fleet ? kind?.radius ?? 0 : 0;
      }
    fleet.version++;
    truth.version++;
  }

  /** Real: a body in the physical world; outside simulator: it perceives both worlds, its body is not real. */
  reality(id: number): "simulated" | "outside simulator" | "real" {
    const entity = this.world.entities.get(id);
    if (!entity) return "simulated";
    if (entity.presence === "physical" || entity.presence === "both") return "real";
    return entity.interaction === "both" || entity.updates === "both" || entity.updates === "physical" ? "outside simulator" : "simulated";
  }

  /** What an aircraft does, in a few words. */
  doing(row: number): string {
    const { fleet, tasks } = this.world, failsafe = fleet.word(row, "failsafe"), reaction = fleet.word(row, "reaction");
    if (failsafe && failsafe !== "none") {
      const does = T.task.reactions[reaction];
      return `${T.task.failsafes[failsafe] ?? failsafe}${does ? `, ${does}` : ""}`;
    }
    const mode = fleet.word(row, "mode");
    if (mode === "manual" || mode === "stabilized") return mode;
    const task = tasks.get(fleet.ids[row]);
    return task ? T.task.verbs[task.what.kind] ?? task.what.kind : T.task.none;
  }

  private readonly text = { name: "", line: "", warned: false };
  private label(row: number) {
    this.text.name = this.world.name(this.world.fleet.ids[row]);
    const silence = this.silence(row);
    this.text.line = silence > 5 ? `${this.doing(row)}, ${T.fleet.age(this.units.seconds(silence))}` : this.doing(row);
    this.text.warned = this.world.fleet.get(row, "failsafe") > 0;
    return this.text;
  }

  /** Seconds since an aircraft was heard of. */
  silence(row: number): number {
    const { fleet } = this.world, heard = fleet.get(row, "heard_s"), age = fleet.get(row, "age_s") || 0;
    return Number.isFinite(heard) ? Math.max(age, fleet.time - heard) : age;
  }

  /** Shows who an event is about; a replay goes to its time. */
  jumpTo(event: KeptEvent): void {
    if (this.run.replay) this.seek(event.time_s);
    if (this.world.fleet.row(event.entity_id) < 0) return;
    this.map.select([event.entity_id]);
    this.map.centreOn(event.entity_id);
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
  const frame = new Frame(run.origin);
  const terrain = await Terrain.load("api/terrain", frame).catch(() => null);
  return new App(run, terrain, frame);
}
