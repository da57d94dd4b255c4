/**
 * All aircraft in one draw call, on a canvas above the map: while the camera stands still the map
 * itself is not drawn again. Nothing is allocated while frames are drawn.
 */
import type { Theme } from "../../report/theme";
import { kMotion, type Fleet } from "../fleet";
import { iconAtlas, kIconKinds, kRealities } from "./icons";
import type { Projector } from "./projector";
import { kIconFragment, kIconVertex, kPlainFragment, kRingFragment, kRingVertex, kStalkVertex, kTailFragment, kTailVertex } from "./air_shaders";

type Program = { program: WebGLProgram; at: Record<string, WebGLUniformLocation | null> };

const kUniforms = ["u_matrix", "u_size", "u_time", "u_flat", "u_icon", "u_old", "u_columns", "u_rows", "u_tints", "u_edge",
  "u_grey", "u_ghost", "u_atlas", "u_colour", "u_seconds", "u_width", "u_points"];

function rgb(colour: string, out: Float32Array, at: number): void {
  const hex = /^#([0-9a-f]{6})$/i.exec(colour);
  const value = hex ? parseInt(hex[1], 16) : 0x888888;
  out[at] = (value >> 16) / 255;
  out[at + 1] = ((value >> 8) & 255) / 255;
  out[at + 2] = (value & 255) / 255;
}

/** Numbers of tints: eight colours of aircraft, then warned and plain. */
export const kTintWarned = 8, kTintPlain = 9;

interface Buffers {
  motion: WebGLBuffer;
  size: number; // of the motion's buffer [bytes]
  vertices: WebGLVertexArrayObject;
  version: number;
}

export class AirLayer {
  readonly canvas: HTMLCanvasElement;
  private readonly gl: WebGL2RenderingContext;
  private programs!: { icon: Program; ring: Program; stalk: Program; tail: Program };
  private quad!: WebGLBuffer;
  private fleet!: Buffers;
  private ghosts!: Buffers;
  private tail!: { buffer: WebGLBuffer; size: number; vertices: WebGLVertexArrayObject; version: number };
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

  constructor(canvas: HTMLCanvasElement) {
    this.canvas = canvas;
    const gl = canvas.getContext("webgl2", { alpha: true, premultipliedAlpha: true, antialias: true, depth: false });
    if (!gl) throw new Error("WebGL 2 is not available");
    this.gl = gl;
    canvas.addEventListener("webglcontextlost", (event) => { event.preventDefault(); this.ready = false; });
    canvas.addEventListener("webglcontextrestored", () => this.prepare());
    this.prepare();
  }

  private program(vertex: string, fragment: string): Program {
    const gl = this.gl, program = gl.createProgram()!;
    for (const [type, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]] as const) {
      const shader = gl.createShader(type)!;
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
        throw new Error(gl.getShaderInfoLog(shader) ?? "a shader");
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    return { program, at: Object.fromEntries(kUniforms.map((name) => [name, gl.getUniformLocation(program, name)])) };
  }

  private corners(): void {
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.quad);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
  }

  private buffers(): Buffers {
    const gl = this.gl, vertices = gl.createVertexArray()!, motion = gl.createBuffer()!;
    gl.bindVertexArray(vertices);
    this.corners();
    gl.bindBuffer(gl.ARRAY_BUFFER, motion);
    for (let k = 0; k < 4; ++k) {
      gl.enableVertexAttribArray(1 + k);
      gl.vertexAttribPointer(1 + k, 4, gl.FLOAT, false, 4 * kMotion, 16 * k);
      gl.vertexAttribDivisor(1 + k, 1);
    }
    gl.bindVertexArray(null);
    return { motion, size: 0, vertices, version: -1 };
  }

  private prepare(): void {
    const gl = this.gl;
    this.programs = {
      icon: this.program(kIconVertex, kIconFragment), ring: this.program(kRingVertex, kRingFragment),
      stalk: this.program(kStalkVertex, kPlainFragment), tail: this.program(kTailVertex, kTailFragment),
    };
    this.quad = gl.createBuffer()!;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.quad);
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), gl.STATIC_DRAW);
    this.fleet = this.buffers();
    this.ghosts = this.buffers();
    const vertices = gl.createVertexArray()!, buffer = gl.createBuffer()!;
    gl.bindVertexArray(vertices);
    this.corners();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    for (let k = 0; k < 2; ++k) {
      gl.enableVertexAttribArray(1 + k);
      gl.vertexAttribPointer(1 + k, 4, gl.FLOAT, false, 16, 16 * k);
      gl.vertexAttribDivisor(1 + k, 1);
    }
    gl.bindVertexArray(null);
    this.tail = { buffer, size: 0, vertices, version: -1 };

    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, true);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, iconAtlas());
    gl.generateMipmap(gl.TEXTURE_2D);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    this.ready = true;
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

  private upload(to: Buffers, fleet: Fleet): void {
    if (to.version === fleet.version) return;
    const gl = this.gl, data = fleet.motion;
    gl.bindBuffer(gl.ARRAY_BUFFER, to.motion);
    if (to.size !== data.byteLength) {
      gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
      to.size = data.byteLength;
    } else {
      gl.bufferSubData(gl.ARRAY_BUFFER, 0, data, 0, fleet.count * kMotion);
    }
    to.version = fleet.version;
  }

  private uploadTails(fleet: Fleet): void {
    if (this.tail.version === fleet.tailVersion) return;
    const gl = this.gl;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.tail.buffer);
    if (this.tail.size !== fleet.tails.byteLength) {
      gl.bufferData(gl.ARRAY_BUFFER, fleet.tails, gl.DYNAMIC_DRAW);
      this.tail.size = fleet.tails.byteLength;
    } else {
      gl.bufferSubData(gl.ARRAY_BUFFER, 0, fleet.tails, 0, fleet.count * (fleet.tailLength + 1) * 4);
    }
    this.tail.version = fleet.tailVersion;
  }

  private use({ program, at }: Program, camera: Projector, time: number): void {
    const gl = this.gl;
    gl.useProgram(program);
    gl.uniformMatrix4fv(at.u_matrix, false, camera.matrix32);
    gl.uniform2f(at.u_size, camera.width, camera.height);
    gl.uniform1f(at.u_time, time);
    gl.uniform1f(at.u_flat, camera.flat ? 1 : 0);
  }

  private icons(buffers: Buffers, fleet: Fleet, camera: Projector, time: number, ghost: boolean): void {
    const gl = this.gl, { icon } = this.programs;
    this.use(icon, camera, time - fleet.epoch);
    gl.uniform1f(icon.at.u_icon, fleet.count > 200 ? 11 : fleet.count > 40 ? 15 : 19);
    gl.uniform1f(icon.at.u_old, ghost ? -1e9 : time - fleet.epoch - this.oldAfter);
    gl.uniform1f(icon.at.u_columns, kIconKinds.length);
    gl.uniform1f(icon.at.u_rows, kRealities.length);
    gl.uniform3fv(icon.at.u_tints, this.tints);
    gl.uniform3fv(icon.at.u_edge, this.edge);
    gl.uniform3fv(icon.at.u_grey, this.grey);
    gl.uniform1f(icon.at.u_ghost, ghost ? 1 : 0);
    gl.bindVertexArray(buffers.vertices);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, fleet.count);
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
    if (this.showTails && fleet.tailLength > 0) {
      this.uploadTails(fleet);
      const { tail } = this.programs;
      this.use(tail, camera, now);
      gl.uniform1f(tail.at.u_seconds, this.seconds);
      gl.uniform1f(tail.at.u_width, fleet.count > 40 ? 1.2 : 2.2);
      gl.uniform1i(tail.at.u_points, fleet.tailLength + 1);
      gl.uniform4fv(tail.at.u_colour, this.tailColour);
      gl.bindVertexArray(this.tail.vertices);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, fleet.count * (fleet.tailLength + 1) - 1);
    }
    if (!camera.flat) {
      this.use(this.programs.stalk, camera, now);
      gl.uniform4fv(this.programs.stalk.at.u_colour, this.stalkColour);
      gl.bindVertexArray(this.fleet.vertices);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, fleet.count);
    }
    if (this.showRings) {
      this.use(this.programs.ring, camera, now);
      gl.uniform4fv(this.programs.ring.at.u_colour, this.ringColour);
      gl.bindVertexArray(this.fleet.vertices);
      gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, fleet.count);
    }
    if (this.showTruth && truth.count > 0) {
      this.upload(this.ghosts, truth);
      this.icons(this.ghosts, truth, camera, time, true);
    }
    this.icons(this.fleet, fleet, camera, time, false);
    gl.bindVertexArray(null);
  }
}
