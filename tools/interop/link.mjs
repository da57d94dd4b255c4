// SPDX-License-Identifier: Apache-2.0
// Frames of node-mavlink through a running `skein link`: who gets them, that not a byte is
// changed, and what the record holds.
//
//   tools/interop/run link.mjs SKEIN      (build/release/skein)
import { spawn } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import mavlink from 'node-mavlink';
import { check, checkEqual, complain, finish, until } from './check.mjs';
import { KINDS, MavLinkPacketSignature, Writer, reader, tcpClient, udpClient } from './peer.mjs';
import { agreedValue } from './values.mjs';

const KEY = MavLinkPacketSignature.key('the vehicles have it, the link has not');
const HEARTBEAT = 0, COMMAND_LONG = 76, COMMAND_ACK = 77, SETUP_SIGNING = 256;
const TIME_BYTES = 8;  // before each frame of a record
// Of what Skein knows, signatures are left out of records; the rest stays as it is.
const KNOWN = new Set(
  fs.readFileSync(new URL('../../src/skein/link/mavlink/messages.txt', import.meta.url), 'utf8')
    .match(/^\d+(?= [A-Z])/gm).map(Number));
// Of no dialect.
const UNKNOWN_ID = 0xabcde;
const UNKNOWN_SHORT_ID = Array.from({ length: 256 }, (_, id) => id)
  .find((id) => !KNOWN.has(id) && mavlink.MSG_ID_MAGIC_NUMBER[id] === undefined);
const CHANGED_FIELDS = { target_system: 'system', target_component: 'component' };

// A program at one end of the link.
class Program {
  received = Buffer.alloc(0);
  packets = [];
  #writer = new Writer();
  // The same frames unsigned, with the same counts: what a record holds of signed ones.
  #unsigned = new Writer();

  constructor(link, name, system, component) {
    Object.assign(this, { link, name, system, component });
    const stream = reader((packet) => this.packets.push(packet));
    link.onBytes = (bytes) => {
      this.received = Buffer.concat([this.received, bytes]);
      stream.write(bytes);
    };
  }

  /** A frame to a target (0: all): what goes out, and what a record holds of it. */
  frame(id, { to = [0, 0], version = 2, signed = false, round = 5 } = {}) {
    const kind = KINDS.get(id);
    const message = new kind();
    for (const field of kind.FIELDS) message[field.name] = agreedValue(id, round, field);
    for (const field of kind.FIELDS) {
      if (CHANGED_FIELDS[field.source] === 'system') [message[field.name]] = to;
      if (CHANGED_FIELDS[field.source] === 'component') [, message[field.name]] = to;
    }
    const from = [message, version, this.system, this.component];
    const recorded = this.#unsigned.frame(...from);
    const bytes = this.#writer.frame(...from, signed ? { key: KEY, link: 7 } : null);
    return { bytes, recorded: KNOWN.has(id) ? recorded : bytes };
  }

  /** A frame with an id that nobody knows: recorded as it is. */
  unknownFrame(id, options) {
    const { bytes } = this.frame(HEARTBEAT, options);
    if (options.version === 1) bytes[5] = id;
    else bytes.writeUIntLE(id, 7, 3);
    return { bytes, recorded: bytes };
  }
}

const [program] = process.argv.slice(2);
const begin = Date.now();
const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'skein-interop-'));
process.on('exit', () => fs.rmSync(folder, { recursive: true }));
const tlog = path.join(folder, 'flight.tlog');
const skein = spawn(program, ['link', 'udpin:0', 'tcpin:0', '--tlog', tlog]);
process.on('exit', () => skein.kill('SIGKILL'));
let news = '', table = '';
skein.stderr.on('data', (text) => { news += text; });
skein.stdout.on('data', (text) => { table += text; });
const exit = new Promise((resolve) => skein.on('exit', (code) => resolve(code)));
const port = async (kind) => {
  const place = new RegExp(`waiting at ${kind}:127.0.0.1:(\\d+)\n`);
  await until(() => place.test(news), `${kind} of the link`);
  return Number(place.exec(news)[1]);
};
const first = new Program(await udpClient(await port('udpin')), 'first vehicle', 1, 1);
const second = new Program(await tcpClient(await port('tcpin')), 'second vehicle', 2, 1);
const station = new Program(await tcpClient(await port('tcpin')), 'station', 255, 190);
const all = [first, second, station];
await until(() => news.match(/is open/g)?.length === 2, 'the connections');

// What each must have got, and the record, so far.
const due = new Map(all.map((one) => [one, Buffer.alloc(0)]));
const recorded = [];

async function arrived(what) {
  await until(() => all.every((one) => one.received.length >= due.get(one).length), what);
  for (const one of all)
    if (!one.received.equals(due.get(one))) {
      complain(`${what}: ${one.name} got something else`);
      due.set(one, one.received);
    }
}

/** Sends frames from one program, and waits until the others have them. */
async function pass(what, from, frames, to, isRecorded = true) {
  from.link.send(Buffer.concat(frames.map(({ bytes }) => bytes)));
  if (isRecorded) recorded.push(...frames.map((frame) => frame.recorded));
  for (const one of to)
    due.set(one, Buffer.concat([due.get(one), ...frames.map(({ bytes }) => bytes)]));
  await arrived(what);
}

const others = (from) => all.filter((one) => one !== from);

for (const one of all)
  await pass('heartbeat', one, [one.frame(HEARTBEAT)], others(one));
for (const signed of [false, true]) {
  const order = (...to) => [station.frame(COMMAND_LONG, { to, signed })];
  await pass('for a component', station, order(1, 1), [first]);
  await pass('for a system', station, order(2, 0), [second]);
  await pass('for a component that was not heard', station, order(1, 100), []);
  await pass('for a system that was not heard', station, order(77, 0), []);
  await pass('for all', station, order(0, 0), [first, second]);
  await pass('an answer', first, [first.frame(COMMAND_ACK, { to: [255, 190], signed })], [station]);
  await pass('among vehicles', second, [second.frame(COMMAND_LONG, { to: [1, 1], signed })],
             [first]);
  await pass('a key', station, [station.frame(SETUP_SIGNING, { to: [1, 1], signed })], [], false);
  await pass('unknown', second, [second.unknownFrame(UNKNOWN_ID, { signed })], others(second));
}
await pass('unknown, version 1', first, [first.unknownFrame(UNKNOWN_SHORT_ID, { version: 1 })], others(first));

// Every kind that node-mavlink has, with those that Skein does not know; several a datagram.
const ids = [...KINDS.keys()].filter((id) => id !== SETUP_SIGNING);
for (const [from, options] of [[first, { version: 2 }], [second, { version: 2, signed: true }],
                               [station, { version: 1 }]]) {
  const sent = ids.filter((id) => options.version === 2 || id < 256);
  for (let i = 0; i < sent.length; i += 4)
    await pass('every kind', from, sent.slice(i, i + 4).map((id) => from.frame(id, options)),
               others(from));
}

// Cut into single bytes, with noise and a frame with a wrong byte between.
const broken = Buffer.from(second.frame(HEARTBEAT).bytes);
broken[12] ^= 1;
for (let k = 0; k < 10; ++k) {
  const frame = station.frame(HEARTBEAT);
  const noise = Buffer.concat([Buffer.from('no frame'), broken]);
  for (const byte of noise) station.link.send(Buffer.from([byte]));
  await pass('after noise', station, [frame], others(station));
}
const end = Date.now();
skein.kill('SIGINT');
checkEqual(await exit, 0, 'exit status');
for (const one of all)
  check(new RegExp(` ${one.system} +(udpin|tcpin)`).test(table), `the table lacks ${one.system}`);

// What arrived is what its senders signed, and readable.
for (const one of all) {
  const signed = one.packets.filter(({ signature }) => signature);
  check(signed.every(({ signature }) => signature.matches(KEY)), `${one.name}: signatures`);
  console.log(`${one.name}: ${one.received.length} bytes, ${one.packets.length} frames of known ` +
              `kinds, ${signed.length} of them signed`);
}
check(station.packets.some(({ signature }) => signature), 'no signed frame came');

// The record: byte for byte, and as node-mavlink reads it.
const record = fs.readFileSync(tlog);
let at = 0, last = 0n;
for (const frame of recorded) {
  if (!check(at + TIME_BYTES + frame.length <= record.length, 'the record ends early')) break;
  const time = record.readBigUInt64BE(at);
  check(time >= last && Number(time / 1000n) >= begin && Number(time / 1000n) <= end,
        `a time of the record is ${time}`);
  last = time;
  at += TIME_BYTES;
  if (!check(record.subarray(at, at + frame.length).equals(frame),
             `frame at ${at} of the record`)) break;
  at += frame.length;
}
checkEqual(record.length, at, 'bytes of the record');
const splitter = new mavlink.MavLinkTLogPacketSplitter();
const read = [];
const parser = splitter.pipe(new mavlink.MavLinkPacketParser());
parser.on('data', (packet) => read.push(packet));
splitter.end(record);
await new Promise((resolve) => parser.on('end', resolve));
checkEqual(read.length + splitter.unknownPackagesCount, recorded.length, 'frames of the record');
checkEqual(splitter.invalidPackages, 0, 'bad frames of the record');
check(read.every(({ signature, header }) => signature === null || !KNOWN.has(header.msgid)),
      'the record has signatures');
console.log(`record: ${recorded.length} frames, ${read.length} of kinds that node-mavlink knows`);
all.forEach((one) => one.link.close());
console.log(`${((Date.now() - begin) / 1000).toFixed(1)} s`);
finish();
