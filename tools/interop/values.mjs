// SPDX-License-Identifier: Apache-2.0
// Values of messages that two programs know of each other without having been told:
// src/skein/link/router/test/agreed_values.h makes the same ones, and says which.

/** A pseudo-random number that a text stands for: FNV-1a, its bits mixed. */
function draw(text) {
  let hash = 0x811c9dc5;
  for (let i = 0; i < text.length; ++i) hash = Math.imul(hash ^ text.charCodeAt(i), 0x01000193);
  hash = Math.imul(hash ^ (hash >>> 16), 0x85ebca6b);
  hash = Math.imul(hash ^ (hash >>> 13), 0xc2b2ae35);
  return (hash ^ (hash >>> 16)) >>> 0;
}

const ZERO = 0, GREATEST = 1, LOWEST = 2, NAN = 3, SPARSE = 4;

/** The bits of an element of a field. */
function bitsOf(id, round, field, type, width, index) {
  const style = round % 6;
  const all = (1n << BigInt(8 * width)) - 1n;
  const real = type === 'float', signed = type.startsWith('int');
  const drawn = (what) => draw(`${id}.${round}.${field}.${index}.${what}`);
  if (style === ZERO) return 0n;
  if (style === GREATEST) return real ? 0x7f800000n : signed ? all >> 1n : all;
  if (style === LOWEST) return real ? 0xff7fffffn : signed ? all - (all >> 1n) : 0n;
  if (style === NAN && real) return BigInt((0x7fc00000 | (drawn('lo') & 0x803fffff)) >>> 0);
  if (style === SPARSE && drawn('zero') % 2 === 0) return 0n;
  return ((BigInt(drawn('hi')) << 32n) | BigInt(drawn('lo'))) & all;
}

/** A text: bytes from 1 to 255, as node-mavlink keeps them, one for each character. */
function textOf(id, round, field, count) {
  const style = round % 6;
  if (style === ZERO || style === LOWEST) return '';
  if (style === GREATEST) return 'Z'.repeat(count);
  const length = draw(`${id}.${round}.${field}.0.length`) % (count + 1);
  let text = '';
  for (let i = 0; i < length; ++i)
    text += String.fromCharCode(1 + (draw(`${id}.${round}.${field}.${i}.lo`) % 255));
  return text;
}

const view = new DataView(new ArrayBuffer(8));

/** The number that bits are of a type: a bigint for 64-bit integers. */
function numberOf(bits, type) {
  view.setBigUint64(0, bits, true);
  switch (type) {
    case 'float': return view.getFloat32(0, true);
    case 'int8_t': return view.getInt8(0);
    case 'int16_t': return view.getInt16(0, true);
    case 'int32_t': return view.getInt32(0, true);
    case 'int64_t': return view.getBigInt64(0, true);
    case 'uint64_t': return bits;
    default: return Number(bits);
  }
}

/** The element type of a field of node-mavlink. */
export function typeOf(field) {
  return field.type.replace('[]', '').replace('_mavlink_version', '');
}

/** What a field of node-mavlink holds in a round of a kind of message. */
export function agreedValue(id, round, field) {
  const type = typeOf(field);
  if (type === 'char') return textOf(id, round, field.source, field.length);
  const one = (i) => numberOf(bitsOf(id, round, field.source, type, field.size, i), type);
  return field.length ? Array.from({ length: field.length }, (_, i) => one(i)) : one(0);
}

/** The bits of a field's floats, to compare what lies in a payload. */
export function agreedBits(id, round, field) {
  return Array.from({ length: field.length || 1 }, (_, i) =>
    Number(bitsOf(id, round, field.source, 'float', 4, i)));
}

/** What a field is that was not sent. */
export function emptyValue(field) {
  const type = typeOf(field);
  if (type === 'char') return '';
  const zero = type.endsWith('int64_t') ? 0n : 0;
  return field.length ? new Array(field.length).fill(zero) : zero;
}

/** Equal with every NaN like every other, and -0 unlike 0. */
export function isEqual(a, b) {
  if (Array.isArray(a)) return a.length === b.length && a.every((x, i) => Object.is(x, b[i]));
  return Object.is(a, b);
}
