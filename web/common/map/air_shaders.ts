// SPDX-License-Identifier: Apache-2.0
/**
 * Shaders of the aircraft layer. Motion is worked out on the graphics card: frames only say the time.
 *
 * Vertices are pulled from textures of floats by their number: six of them make a square. Instances
 * would say the same, but software renderers take each for a draw call of its own.
 */

/** Texels of a row of a texture of floats. */
export const kTexels = 256;

const kHead = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform mat4 u_matrix;
uniform vec2 u_size;      // of the canvas [px]
uniform float u_time;
uniform float u_flat;     // 1: on the plane
vec4 texel(sampler2D of, int k) { return texelFetch(of, ivec2(k % ${kTexels}, k / ${kTexels}), 0); }
vec2 corner() {
  int k = gl_VertexID % 6;
  return vec2(k == 1 || k == 2 || k == 4 ? 1.0 : -1.0, k == 2 || k == 4 || k == 5 ? 1.0 : -1.0);
}
const vec4 kNowhere = vec4(2.0, 2.0, 2.0, 1.0);
`;

// The place at the time u_time: between the last two frames, at most 1 s beyond.
const kPlace = `
uniform sampler2D u_motion;
vec4 a_before, a_now;
vec4 a_more;   // headings before and now, icon, tint
vec4 a_extra;  // ground, heard, radius of the safety zone
void pull() {
  int row = gl_VertexID / 6;
  a_before = texel(u_motion, 4 * row);
  a_now = texel(u_motion, 4 * row + 1);
  a_more = texel(u_motion, 4 * row + 2);
  a_extra = texel(u_motion, 4 * row + 3);
}
float fraction() {
  float span = a_now.w - a_before.w;
  return span > 1e-4 ? max(0.0, (min(u_time, a_now.w + 1.0) - a_before.w) / span) : 1.0;
}
vec3 place(float f) {
  vec3 p = mix(a_before.xyz, a_now.xyz, f);
  p.z *= 1.0 - u_flat;
  return p;
}
`;

export const kIconVertex = `${kHead}${kPlace}
uniform float u_icon;     // half the width of an icon [px]
uniform float u_old;      // aircraft not heard of since then are old
uniform float u_columns, u_rows;
uniform vec3 u_tints[10];
uniform float u_ghost;
out vec2 v_uv;
out vec3 v_tint;
out float v_old;
void main() {
  pull();
  vec2 a_corner = corner();
  float f = fraction();
  vec3 p = place(f);
  float turn = a_more.y - a_more.x;
  turn -= 6.2831853 * round(turn / 6.2831853);
  float heading = a_more.x + min(f, 1.5) * turn;
  vec4 clip = u_matrix * vec4(p, 1.0);
  // The direction of the nose on the screen.
  float ahead = max(1.0, clip.w * 0.01) * 0.5;
  vec4 nose = u_matrix * vec4(p + ahead * vec3(sin(heading), -cos(heading), 0.0), 1.0);
  vec2 d = (nose.xy / nose.w - clip.xy / clip.w) * u_size;
  d = length(d) > 1e-6 ? normalize(d) : vec2(0.0, 1.0);
  vec2 offset = mat2(d.y, -d.x, d.x, d.y) * a_corner;
  gl_Position = clip.w > 0.0 ? vec4(clip.xy + 2.0 * u_icon * offset / u_size * clip.w, 0.0, clip.w) : kNowhere;
  int icon = int(a_more.z);
  vec2 cell = vec2(float(icon % int(u_columns)), float(icon / int(u_columns)));
  v_uv = (cell + vec2(0.5) + vec2(0.5, -0.5) * a_corner) / vec2(u_columns, u_rows);
  v_tint = u_tints[int(a_more.w)];
  v_old = a_extra.y < u_old ? 1.0 : 0.0;
}`;

export const kIconFragment = `#version 300 es
precision mediump float;
in vec2 v_uv;
in vec3 v_tint;
in float v_old;
uniform sampler2D u_atlas;
uniform vec3 u_edge;
uniform vec3 u_grey;
uniform float u_ghost;
out vec4 colour;
void main() {
  vec4 t = texture(u_atlas, v_uv);
  vec3 tint = mix(v_tint, u_grey, v_old);
  float fill = t.r, line = max(t.g, t.r), ring = t.b;
  // Old: hollow, the outline says it too.
  vec3 inside = mix(tint, u_edge, v_old);
  vec3 rgb = mix(mix(u_edge, tint, v_old), inside, fill);
  float a = max(line, ring);
  rgb = mix(tint, rgb, line > 0.01 ? line : 0.0);
  if (u_ghost > 0.5) {
    a = max(line - fill, 0.0) * 0.9;
    rgb = tint;
  }
  colour = vec4(rgb * a, a);
}`;

export const kRingVertex = `${kHead}${kPlace}
out vec2 v_corner;
out float v_pixels;
void main() {
  pull();
  vec2 a_corner = corner();
  vec3 p = place(fraction());
  float radius = a_extra.z;
  vec4 clip = u_matrix * vec4(p + vec3(radius * a_corner, 0.0), 1.0);
  vec4 middle = u_matrix * vec4(p, 1.0);
  vec4 side = u_matrix * vec4(p + vec3(radius, 0.0, 0.0), 1.0);
  v_pixels = length((side.xy / side.w - middle.xy / middle.w) * 0.5 * u_size);
  gl_Position = radius > 0.0 && middle.w > 0.0 && v_pixels > 12.0 ? vec4(clip.xy, 0.0, clip.w) : kNowhere;
  v_corner = a_corner;
}`;

export const kRingFragment = `#version 300 es
precision mediump float;
in vec2 v_corner;
in float v_pixels;
uniform vec4 u_colour;
out vec4 colour;
void main() {
  float r = length(v_corner) * v_pixels;
  float a = clamp(1.4 - abs(r - v_pixels + 1.5), 0.0, 1.0);
  float angle = atan(v_corner.y, v_corner.x);
  a *= step(0.45, fract(angle * 6.0)); // dashed
  if (a <= 0.0) discard;
  colour = u_colour * a;
}`;

export const kStalkVertex = `${kHead}${kPlace}
void main() {
  pull();
  vec2 a_corner = corner();
  vec3 top = place(fraction());
  vec4 a = u_matrix * vec4(top, 1.0), b = u_matrix * vec4(top.xy, a_extra.x, 1.0);
  vec4 clip = a_corner.y > 0.0 ? a : b;
  gl_Position = a.w > 0.0 && b.w > 0.0 ? vec4(clip.xy + a_corner.x * 1.2 / u_size * clip.w, 0.0, clip.w) : kNowhere;
}`;

export const kPlainFragment = `#version 300 es
precision mediump float;
uniform vec4 u_colour;
out vec4 colour;
void main() { colour = u_colour; }`;

export const kTailVertex = `${kHead}
uniform sampler2D u_tails;
uniform float u_seconds, u_width;
uniform int u_points;   // of an aircraft, the repeated one included
out float v_alpha;
out float v_across;
void main() {
  vec2 a_corner = corner();  // y: -1 at the older end, 1 at the newer
  int segment = gl_VertexID / 6;
  vec4 a_old = texel(u_tails, segment), a_new = texel(u_tails, segment + 1);
  v_across = a_corner.x;
  float age = u_time - a_new.w;
  bool gone = segment % u_points == u_points - 1 || a_new.w <= a_old.w || a_new.w - a_old.w > 60.0 ||
    a_old.w >= u_time || age > u_seconds;
  vec4 newer = a_new;
  if (newer.w > u_time) newer = mix(a_old, a_new, (u_time - a_old.w) / (a_new.w - a_old.w));
  float up = 1.0 - u_flat;
  vec4 a = u_matrix * vec4(a_old.xy, a_old.z * up, 1.0), b = u_matrix * vec4(newer.xy, newer.z * up, 1.0);
  if (gone || a.w <= 0.0 || b.w <= 0.0) { gl_Position = kNowhere; v_alpha = 0.0; return; }
  vec2 d = (b.xy / b.w - a.xy / a.w) * u_size;
  vec2 across = length(d) > 1e-5 ? normalize(vec2(-d.y, d.x)) : vec2(0.0);
  vec4 clip = a_corner.y > 0.0 ? b : a;
  gl_Position = vec4(clip.xy + a_corner.x * (u_width + 1.0) * across / u_size * clip.w, 0.0, clip.w);
  float t = a_corner.y > 0.0 ? newer.w : a_old.w;
  v_alpha = clamp(1.0 - (u_time - t) / u_seconds, 0.0, 1.0);
}`;

export const kTailFragment = `#version 300 es
precision mediump float;
in float v_alpha;
in float v_across;
uniform vec4 u_colour;
out vec4 colour;
void main() { colour = u_colour * (0.15 + 0.75 * v_alpha) * step(0.001, v_alpha) * min(1.0, 2.0 - 2.0 * abs(v_across)); }`;

export const kLabelVertex = `${kHead}
uniform sampler2D u_motion;
uniform vec2 u_texture;
out vec2 v_uv;
void main() {
  int row = 4 * (gl_VertexID / 6);
  vec2 a_corner = corner();
  vec4 a_before = texel(u_motion, row), a_now = texel(u_motion, row + 1);
  vec4 a_box = texel(u_motion, row + 2);   // offset and size [px]
  vec4 a_slot = texel(u_motion, row + 3);  // its corner in the texture [px]
  float span = a_now.w - a_before.w;
  float f = span > 1e-4 ? max(0.0, (min(u_time, a_now.w + 1.0) - a_before.w) / span) : 1.0;
  vec3 p = mix(a_before.xyz, a_now.xyz, f);
  vec4 clip = u_matrix * vec4(p.xy, p.z * (1.0 - u_flat), 1.0);
  vec2 at = (clip.xy / clip.w * vec2(0.5, -0.5) + 0.5) * u_size;
  vec2 inside = 0.5 + 0.5 * a_corner;
  vec2 pixel = floor(at + a_box.xy + 0.5) + inside * a_box.zw; // whole pixels: text stays sharp
  gl_Position = clip.w > 0.0 ? vec4((pixel / u_size - 0.5) * vec2(2.0, -2.0), 0.0, 1.0) : kNowhere;
  v_uv = (a_slot.xy + inside * a_box.zw) / u_texture;
}`;

export const kLabelFragment = `#version 300 es
precision mediump float;
in vec2 v_uv;
uniform sampler2D u_atlas;
out vec4 colour;
void main() { colour = texture(u_atlas, v_uv); }`;
