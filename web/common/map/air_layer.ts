// SPDX-License-Identifier: Apache-2.0
/**
 * All aircraft in one draw call, on a canvas above the map: while the camera stands still the map
 * itself is not drawn again. Nothing is allocated while frames are drawn.
 */
import type { Theme } from "../theme";
import { kMotion, type Fleet } from "../fleet";
import { T } from "../texts";
import { iconAtlas, kIconKinds, kRealities } from "./icons";
import type { Labels } from "./labels";
import type { Projector } from "./projector";
import {
  kIconFragment,
  kIconVertex,
  kLabelFragment,
  kLabelVertex,
  kPlainFragment,
  kRingFragment,
  kRingVertex,
  kStalkVertex,
  kTailFragment,
  kTailVertex,
  kTexels,
} from "./air_shaders";

type Program = { program: WebGLProgram; at: Record<string, WebGLUniformLocation | null> };

const kUniforms = [
  "u_matrix",
  "u_size",
  "u_time",
  "u_flat",
  "u_icon",
  "u_old",
  "u_columns",
  "u_rows",
  "u_tints",
  "u_edge",
  "u_grey",
  "u_ghost",
  "u_atlas",
  "u_colour",
  "u_seconds",
  "u_width",
  "u_points",
  "u_texture",
  "u_motion",
  "u_tails",
];

function rgb(colour: string, out: Float32Array, at: number): void {
  const hex = /^#([0-9a-f]{6})$/i.exec(colour);
  const value = hex ? parseInt(hex[1], 16) : 0x888888;
  out[at] = (value >> 16) / 255;
  out[at + 1] = ((value >> 8) & 255) / 255;
  out[at + 2] = (value & 255) / 255;
}

/** Numbers of tints: eight colours of aircraft, then warned and plain. */
export const kTintWarned = 8,
  kTintPlain = 9;

/** Units of textures. */
const kAtlasUnit = 0,
  kLabelUnit = 1,
  kFleetUnit = 2,
  kGhostUnit = 3,
  kTailUnit = 4,
  kInstanceUnit = 5;

/** Rows of floats on the graphics card. */
class Floats {
  version = -1;
  private height = 0;
  private readonly texture: WebGLTexture;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    readonly unit: number,
  ) {
    this.texture = gl.createTexture()!;
    this.bind();
    for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, side, gl.NEAREST);
  }

  private bind(): void {
    this.gl.activeTexture(this.gl.TEXTURE0 + this.unit);
    this.gl.bindTexture(this.gl.TEXTURE_2D, this.texture);
  }

  /** Uploads the first `texels` of the data, whose length fills whole rows. */
  upload(data: Float32Array, texels: number): void {
    const gl = this.gl,
      height = data.length / (4 * kTexels),
      rows = Math.min(height, Math.ceil(texels / kTexels));
    this.bind();
    if (this.height !== height) {
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA32F, kTexels, height, 0, gl.RGBA, gl.FLOAT, data);
      this.height = height;
    } else if (rows > 0) {
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, kTexels, rows, gl.RGBA, gl.FLOAT, data, 0);
    }
  }
}

export class AirLayer {
  readonly canvas: HTMLCanvasElement;
  private readonly gl: WebGL2RenderingContext;
  private programs!: { icon: Program; ring: Program; stalk: Program; tail: Program; label: Program };
  private fleet!: Floats;
  private ghosts!: Floats;
  private tails!: Floats;
  private instances!: Floats;
  private pictures: WebGLTexture | null = null;
  private readonly tints = new Float32Array(30);
  private readonly edge = new Float32Array(3);
  private readonly grey = new Float32Array(3);
  private readonly tailColour = new Float32Array(4);
  private readonly ringColour = new Float32Array(4);
  private readonly stalkColour = new Float32Array(4);
  private ready = false;
  seconds = 120; // of the tails
  showTails = true;
  showTruth = true;
  showRings = true;
  oldAfter = 5; // [s]

  constructor(
    canvas: HTMLCanvasElement,
    private readonly labels: Labels,
  ) {
    this.canvas = canvas;
    const gl = canvas.getContext("webgl2", { alpha: true, premultipliedAlpha: true, antialias: false, depth: false, stencil: false });
    if (!gl) throw new Error(T.map.noWebgl);
    this.gl = gl;
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.ready = false;
    });
    canvas.addEventListener("webglcontextrestored", () => this.prepare());
    this.prepare();
  }

  private program(vertex: string, fragment: string): Program {
    const gl = this.gl,
      program = gl.createProgram()!;
    for (const [type, source] of [
      [gl.VERTEX_SHADER, vertex],
      [gl.FRAGMENT_SHADER, fragment],
    ] as const) {
      const shader = gl.createShader(type)!;
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) throw new Error(gl.getShaderInfoLog(shader) ?? "a shader");
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return { program, at: Object.fromEntries(kUniforms.map((name) => [name, gl.getUniformLocation(program, name)])) };
  }

  private prepare(): void {
    const gl = this.gl;
    this.programs = {
      icon: this.program(kIconVertex, kIconFragment),
      ring: this.program(kRingVertex, kRingFragment),
      stalk: this.program(kStalkVertex, kPlainFragment),
      tail: this.program(kTailVertex, kTailFragment),
      label: this.program(kLabelVertex, kLabelFragment),
    };
    this.fleet = new Floats(gl, kFleetUnit);
    this.ghosts = new Floats(gl, kGhostUnit);
    this.tails = new Floats(gl, kTailUnit);
    this.instances = new Floats(gl, kInstanceUnit);
    this.pictures = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0 + kLabelUnit);
    gl.bindTexture(gl.TEXTURE_2D, this.pictures);
    const [width, height] = this.labels.texturePixels;
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, width, height);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    this.labels.forget();
    this.labels.onPicture = (x, y, picture) => {
      gl.activeTexture(gl.TEXTURE0 + kLabelUnit);
      gl.bindTexture(gl.TEXTURE_2D, this.pictures);
      gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, true);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, x, y, gl.RGBA, gl.UNSIGNED_BYTE, picture);
      gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
    };
    gl.activeTexture(gl.TEXTURE0 + kAtlasUnit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, true);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, iconAtlas());
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false); // it would multiply floats too
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_NEAREST);
    gl.bindVertexArray(gl.createVertexArray()); // empty: vertices are pulled
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.ready = true;
  }

  /** Gives the graphics card back what it holds. */
  lose(): void {
    this.ready = false;
    this.gl.getExtension("WEBGL_lose_context")?.loseContext();
  }

  setTheme(theme: Theme, warned: string): void {
    theme.series.forEach((colour, k) => rgb(colour, this.tints, 3 * k));
    rgb(warned, this.tints, 3 * kTintWarned);
    rgb(theme.belief, this.tints, 3 * kTintPlain);
    rgb(theme.paper, this.edge, 0);
    rgb(theme.muted, this.grey, 0);
    const premultiplied = (colour: string, alpha: number, out: Float32Array) => {
      rgb(colour, out, 0);
      for (let k = 0; k < 3; ++k) out[k] *= alpha;
      out[3] = alpha;
    };
    premultiplied(theme.ink, 0.75, this.tailColour);
    premultiplied(theme.ink, 0.7, this.ringColour);
    premultiplied(theme.ink, 0.45, this.stalkColour);
  }

  private upload(to: Floats, fleet: Fleet): void {
    if (to.version === fleet.version) return;
    to.version = fleet.version;
    to.upload(fleet.motion, (fleet.count * kMotion) / 4);
  }

  private uploadTails(fleet: Fleet): void {
    if (this.tails.version === fleet.tailVersion) return;
    this.tails.version = fleet.tailVersion;
    this.tails.upload(fleet.tails, fleet.count * (fleet.tailLength + 1));
  }

  private drawLabels(fleet: Fleet, camera: Projector, time: number): void {
    const gl = this.gl,
      { labels } = this,
      { label } = this.programs;
    if (labels.count === 0) return;
    if (labels.refresh(fleet)) this.instances.upload(labels.instances, 4 * labels.count);
    this.use(label, camera, time);
    const [width, height] = labels.textureSize;
    gl.uniform2f(label.at.u_texture, width, height);
    gl.uniform1i(label.at.u_motion, kInstanceUnit);
    gl.uniform1i(label.at.u_atlas, kLabelUnit);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * labels.count);
  }

  private use({ program, at }: Program, camera: Projector, time: number): void {
    const gl = this.gl;
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.u_matrix, false, camera.matrix32);
    gl.uniform2f(at.u_size, camera.width, camera.height);
    gl.uniform1f(at.u_time, time);
    gl.uniform1f(at.u_flat, camera.flat ? 1 : 0);
  }

  private icons(from: Floats, fleet: Fleet, camera: Projector, time: number, ghost: boolean): void {
    const gl = this.gl,
      { icon } = this.programs;
    this.use(icon, camera, time - fleet.epoch);
    gl.uniform1f(icon.at.u_icon, fleet.count > 200 ? 11 : fleet.count > 40 ? 15 : 19);
    gl.uniform1f(icon.at.u_old, ghost ? -1e9 : time - fleet.epoch - this.oldAfter);
    gl.uniform1f(icon.at.u_columns, kIconKinds.length);
    gl.uniform1f(icon.at.u_rows, kRealities.length);
    gl.uniform3fv(icon.at.u_tints, this.tints);
    gl.uniform3fv(icon.at.u_edge, this.edge);
    gl.uniform3fv(icon.at.u_grey, this.grey);
    gl.uniform1f(icon.at.u_ghost, ghost ? 1 : 0);
    gl.uniform1i(icon.at.u_motion, from.unit);
    gl.uniform1i(icon.at.u_atlas, kAtlasUnit);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * fleet.count);
  }

  private plain(program: Program, fleet: Fleet, camera: Projector, now: number, colour: Float32Array): void {
    const gl = this.gl;
    this.use(program, camera, now);
    gl.uniform4fv(program.at.u_colour, colour);
    gl.uniform1i(program.at.u_motion, kFleetUnit);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * fleet.count);
  }

  private drawTails(fleet: Fleet, camera: Projector, now: number): void {
    const gl = this.gl,
      { tail } = this.programs;
    this.uploadTails(fleet);
    this.use(tail, camera, now);
    gl.uniform1f(tail.at.u_seconds, this.seconds);
    gl.uniform1f(tail.at.u_width, fleet.count > 40 ? 1.2 : 2.2);
    gl.uniform1i(tail.at.u_points, fleet.tailLength + 1);
    gl.uniform4fv(tail.at.u_colour, this.tailColour);
    gl.uniform1i(tail.at.u_tails, kTailUnit);
    gl.drawArrays(gl.TRIANGLES, 0, 6 * (fleet.count * (fleet.tailLength + 1) - 1));
  }

  /** Draws everything at a simulated time. */
  draw(fleet: Fleet, truth: Fleet, camera: Projector, time: number): void {
    if (!this.ready) return;
    const gl = this.gl;
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    if (fleet.count === 0) return;
    this.upload(this.fleet, fleet);
    const now = time - fleet.epoch;
    if (this.showTails && fleet.tailLength > 0) this.drawTails(fleet, camera, now);
    if (!camera.flat) this.plain(this.programs.stalk, fleet, camera, now, this.stalkColour);
    if (this.showRings) this.plain(this.programs.ring, fleet, camera, now, this.ringColour);
    if (this.showTruth && truth.count > 0) {
      this.upload(this.ghosts, truth);
      this.icons(this.ghosts, truth, camera, time, true);
    }
    this.icons(this.fleet, fleet, camera, time, false);
    this.drawLabels(fleet, camera, now);
  }
}
