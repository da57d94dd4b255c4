// SPDX-License-Identifier: Apache-2.0
// Skein's MAVLink against node-mavlink, over real sockets: every kind of message that both
// know, versions 1 and 2, signed and not, both ways, field by field.
//
//   tools/interop/run codec.mjs MAVLINK_PEER      (build/release/mavlink_peer)
//
// For each frame that goes out the other side sends one of the same kind and form back
// (src/skein/link/router/test/mavlink_peer.cpp).
import { spawn } from 'node:child_process';
import { createInterface } from 'node:readline';
import { check, checkEqual, complain, finish, until } from './check.mjs';
import { dice, withGarbage } from './garbage.mjs';
import {
  KINDS, MavLinkPacketSignature, MavLinkProtocolV1, Writer, reader, tcpClient, tcpServer,
  udpClient, udpServer,
} from './peer.mjs';
import { agreedBits, agreedValue, emptyValue, isEqual, typeOf } from './values.mjs';

// Forms of frames, as the system of their sender says; their component says the round.
const FIRST = 11, SECOND = 12, SIGNED = 13, OTHER_KEY = 14, UNANSWERED = 99;
const ROUNDS = 6;
const KEY = MavLinkPacketSignature.key('both know it');
const WRONG_KEY = MavLinkPacketSignature.key('only this side knows it');
const UNKNOWN_ID = 0xabcde;
const MINUTE = 60_000;  // ms

// What one link has seen.
class Session {
  sent = 0; compared = 0; fields = 0; garbage = 0; zeros = 0;
  #expected = [];
  #counts = new Map();  // of frames, by sender
  #stamps = new Map();  // of signatures, by sender and link id
  #writer = new Writer();

  constructor(link, number) {
    this.link = link;
    this.linkId = number;
    const stream = reader((packet) => this.#take(packet));
    link.onBytes = (bytes) => stream.write(bytes);
  }

  message(kind, round) {
    const message = new kind();
    for (const field of kind.FIELDS) message[field.name] = agreedValue(kind.MSG_ID, round, field);
    return message;
  }

  /** A frame that is answered. */
  question(kind, form, round) {
    this.#expected.push({ kind, form, round: round + ROUNDS });
    ++this.sent;
    const frame = this.frame(kind, form, round);
    if (form !== FIRST && frame[1] === 0) ++this.zeros;
    return frame;
  }

  frame(kind, form, round, more = {}) {
    const key = { [SIGNED]: KEY, [OTHER_KEY]: WRONG_KEY }[form];
    const signing = key ? { key, link: this.linkId, ...more.signing } : null;
    return this.#writer.frame(this.message(kind, round), form === FIRST ? 1 : 2, form, round + 1,
                              signing, more.flags ?? 0);
  }

  /** Frames that nobody answers: they complete what a false begin holds back. */
  filler() {
    const message = this.message(KINDS.get(0), ROUNDS - 1);
    return Buffer.concat(Array.from({ length: 16 }, () =>
      this.#writer.frame(message, 2, UNANSWERED, 1)));
  }

  get waiting() { return this.#expected.length; }

  #take(packet) {
    const { sysid, compid, seq, msgid } = packet.header;
    if (sysid === UNANSWERED) return;
    const expected = this.#expected.shift();
    const where = `${this.link.name}: ${KINDS.get(msgid)?.MSG_NAME} of ${sysid}/${compid}`;
    if (!expected || expected.kind.MSG_ID !== msgid || expected.form !== sysid ||
        expected.round + 1 !== compid)
      throw new Error(`${where}, instead of ${expected?.kind.MSG_NAME} of ${expected?.form}`);
    const first = packet.protocol instanceof MavLinkProtocolV1;
    checkEqual(first, sysid === FIRST, `${where}: of version 1`);
    const sender = sysid * 256 + compid;
    checkEqual(seq, ((this.#counts.get(sender) ?? -1) + 1) & 255, `${where}: count`);
    this.#counts.set(sender, seq);
    this.#judge(packet, where);
    this.#compare(packet, expected, first, where);
  }

  #judge(packet, where) {
    const { sysid, compid } = packet.header;
    const signature = packet.signature;
    if (!checkEqual(signature !== null, sysid === SIGNED || sysid === OTHER_KEY,
                    `${where}: signed`) || !signature) return;
    checkEqual(signature.matches(KEY), sysid === SIGNED, `${where}: signature fits`);
    check(!signature.matches(WRONG_KEY), `${where}: signature fits another key`);
    const stream = `${signature.linkId} ${sysid} ${compid}`;
    check(signature.timestamp > (this.#stamps.get(stream) ?? 0), `${where}: a time stamp repeats`);
    this.#stamps.set(stream, signature.timestamp);
  }

  #compare(packet, { kind, round }, first, where) {
    const message = packet.protocol.data(packet.payload, kind);
    for (const field of kind.FIELDS) {
      // Version 1 has no extensions.
      const missing = first && field.extension;
      const value = missing ? emptyValue(field) : agreedValue(kind.MSG_ID, round, field);
      if (!isEqual(message[field.name], value))
        complain(`${where}: ${field.source} is ${message[field.name]}, not ${value}`);
      if (!missing && typeOf(field) === 'float')
        agreedBits(kind.MSG_ID, round, field).forEach((bits, i) =>
          checkEqual(packet.payload.readUInt32LE(field.offset + 4 * i), bits,
                     `${where}: bits of ${field.source}[${i}]`));
      this.fields += field.length || 1;
    }
    ++this.compared;
  }
}

/** Sends frames, several at once and cut anywhere, as the other side keeps up. */
async function sendAll(session, count, makeFrame, garbage = null) {
  const roll = dice(session.linkId);
  const { link } = session;
  for (let done = 0; done < count;) {
    await until(() => session.waiting < (link.isDatagram ? 16 : 128), `${link.name}: answers`);
    const batch = [];
    for (let k = 1 + roll(link.isDatagram ? 4 : 24); k > 0 && done < count; --k)
      batch.push(makeFrame(done++));
    let bytes = Buffer.concat(batch);
    if (garbage) {
      let more;
      [bytes, more] = withGarbage(batch, garbage, roll);
      session.garbage += more;
    }
    if (link.isDatagram) {
      link.send(bytes);
      continue;
    }
    const cut = roll(bytes.length + 1);
    link.send(bytes.subarray(0, cut));
    link.send(bytes.subarray(cut));
  }
}

async function askEverything(session, kinds) {
  const short = kinds.filter((kind) => kind.MSG_ID < 256);
  for (const [form, asked, rounds] of [[FIRST, short, ROUNDS], [SECOND, kinds, ROUNDS],
                                       [SIGNED, kinds, ROUNDS], [OTHER_KEY, kinds, 1]])
    await sendAll(session, asked.length * rounds, (i) =>
      session.question(asked[i % asked.length], form, Math.floor(i / asked.length)));
}

async function askThroughGarbage(session, kinds, knownIds) {
  const short = kinds.filter((kind) => kind.MSG_ID < 256);
  for (const [form, asked] of [[FIRST, short], [SECOND, kinds]])
    await sendAll(session, asked.length,
                  (i) => session.question(asked[i], form, ROUNDS - 1), knownIds);
  session.link.send(session.filler());
}

/** What must be refused; returns how many of each. */
function sendWhatIsRefused(session) {
  const heartbeat = KINDS.get(0);
  const frame = (more) => session.frame(heartbeat, SIGNED, 5, more);
  const fresh = session.question(heartbeat, SIGNED, 5);  // the only good one
  const stamped = new MavLinkPacketSignature(fresh).timestamp / 100 + Date.UTC(2015, 0, 1);
  const changed = frame();
  changed[changed.length - 1] ^= 1;
  // With the signature of another frame.
  const exchanged = frame();
  exchanged.set(fresh.subarray(fresh.length - 6), exchanged.length - 6);
  const old = frame({ signing: { link: 200 + session.linkId, time: Date.now() - 2 * MINUTE } });
  // Two of the same millisecond, which node-mavlink does by itself.
  const twin = frame({ signing: { time: stamped } });
  const incompatible = session.frame(heartbeat, SECOND, 5, { flags: 0x02 });
  const unknown = session.frame(heartbeat, SECOND, 5);
  unknown.writeUIntLE(UNKNOWN_ID, 7, 3);
  session.link.send(fresh);
  for (const bytes of [fresh, changed, exchanged, old, twin, incompatible, unknown])
    session.link.send(bytes);
  return { wrong_key: 2, repeated: 2, old: 1, incompatible: 1, unknown: 1, valid: 1 };
}

function checkDefinitions(definitions) {
  const both = [];
  for (const { id, name, crc_extra: extra, fields } of definitions) {
    const kind = KINDS.get(id);
    if (!kind) continue;
    both.push(kind);
    checkEqual(kind.MSG_NAME, name, `name of ${id}`);
    checkEqual(kind.MAGIC_NUMBER, extra, `${name}: CRC_EXTRA`);
    const theirs = kind.FIELDS.map((f) => `${f.source} ${typeOf(f)} ${f.length} ${f.extension}`);
    checkEqual(theirs.sort().join(', '), fields.map((f) => f.join(' ')).sort().join(', '),
               `${name}: fields`);
  }
  return both;
}

const [program] = process.argv.slice(2);
const begin = Date.now();
const [udpPort, udp] = await udpServer();
const [tcpPort, tcp] = await tcpServer();
const skein = spawn(program, ['udpin:0', 'tcpin:0', `udpout:127.0.0.1:${udpPort}`,
                              `tcp:127.0.0.1:${tcpPort}`],
                    { stdio: ['pipe', 'pipe', 'inherit'] });
const exit = new Promise((resolve) => skein.on('exit', (code) => resolve(code)));
const said = [];
createInterface({ input: skein.stdout }).on('line', (line) => said.push(JSON.parse(line)));
await until(() => said.some((line) => line.places || line.error), 'the begin of the program');
const { places, error } = said.pop();
if (error) throw new Error(error);
const kinds = checkDefinitions(said);
const knownIds = new Set(said.map(({ id }) => id));
console.log(`${kinds.length} kinds are known to both, ${said.length - kinds.length} to Skein alone`);
check(kinds.length >= 176, 'there are fewer kinds than once');
said.length = 0;

const portOf = (place) => Number(place.split(':').at(-1));
const links = [await udpClient(portOf(places[0])), await tcpClient(portOf(places[1])), udp,
               await tcp];
await until(() => udp.to, 'a datagram');
const sessions = links.map((link, i) => new Session(link, i + 1));
const refused = {};

async function talk(session) {
  const { name } = session.link;
  await askEverything(session, kinds);
  await until(() => session.waiting === 0, `${name}: last answers`);
  await askThroughGarbage(session, kinds, knownIds);
  await until(() => session.waiting === 0, `${name}: answers through garbage`);
  for (const [what, count] of Object.entries(sendWhatIsRefused(session)))
    refused[what] = (refused[what] ?? 0) + count;
  // A last good one: then all before it was handled.
  session.link.send(session.question(KINDS.get(0), SECOND, 5));
  await until(() => session.waiting === 0, `${name}: the end`);
  checkEqual(session.compared, session.sent, `${name}: answers`);
  console.log(`${name}: ${session.sent} frames sent, ${session.garbage} bytes of garbage ` +
              `between; ${session.compared} answers, ${session.fields} values compared`);
}

// One after the other; the program's summary says more of what went wrong.
for (const session of sessions) await talk(session).catch((error) => complain(error.message));
skein.stdin.end();
await until(() => said.length > 0, 'the summary of the program');
const summary = said.pop();
summary.texts.forEach((text) => complain(`Skein: ${text}`));
const total = (what) => sessions.reduce((sum, session) => sum + session[what], 0);
console.log(`Skein: ${summary.compared} frames of ${summary.kinds} kinds, ${summary.fields} ` +
            `values compared; refused ${summary.wrong_key} of a wrong key, ` +
            `${summary.repeated} repeated, ${summary.old} old`);
const count = kinds.length;
checkEqual(summary.compared, total('sent'), 'Skein: frames compared');
checkEqual(summary.kinds, count, 'Skein: kinds');
checkEqual(summary.valid, links.length * ROUNDS * count + refused.valid, 'Skein: valid');
checkEqual(summary.wrong_key, links.length * count + refused.wrong_key, 'Skein: of a wrong key');
for (const what of ['repeated', 'old', 'incompatible', 'unknown'])
  checkEqual(summary[what], refused[what], `Skein: ${what}`);
checkEqual(summary.lost, refused.incompatible, 'Skein: frames lost, by their counts');
checkEqual(summary.skipped_bytes, total('garbage'), 'Skein: bytes of no frame');
check(summary.bad_crc > 0, 'Skein: no frame of garbage came near its end');
check(total('zeros') > 0, 'no payload had length 0');
checkEqual(await exit, 0, 'exit status of the program');
links.forEach((link) => link.close());
console.log(`${((Date.now() - begin) / 1000).toFixed(1)} s`);
finish();
