// SPDX-License-Identifier: Apache-2.0
// node-mavlink as the other side of a link. Where it departs from the definition of MAVLink,
// or cannot do what is needed here, this file does otherwise:
//
//  - A payload of zeros goes out with length 0; at least one byte is due. Sent as it is:
//    Skein has to read it.
//  - Version 1 sends extensions too, which it must not. Sent as it is: Skein has to read it.
//    It throws for ids above 255; kinds with such are left out.
//  - A field that was never set holds a word ("GENERIC") that cannot be written: all are set.
//  - send() and sendSigned() count all frames of a program together, so that receivers see
//    losses: frames are counted here for each link and sender.
//  - Signatures take their time in milliseconds, so that frames of the same one repeat a time
//    stamp: each frame gets a millisecond of its own here. A receiver only learns whether a
//    signature fits a key, not whether its time was used before.
//  - Between frames it takes what has an unknown id for a frame, and loses what is in it:
//    garbage is sent to Skein only.
//  - MavEsp8266 sends to a fixed port instead of the one that a peer sends from: sockets
//    are those of Node here.
//  - Numbers are 64-bit floats, which may change the bits of a NaN: those that it sends are
//    compared as NaN, those that it receives bit by bit, in the payload.
//  - A text is one byte for each character, not UTF-8.
import dgram from 'node:dgram';
import net from 'node:net';
import { once } from 'node:events';
import { PassThrough } from 'node:stream';
import mavlink from 'node-mavlink';

export const { MavLinkProtocolV1, MavLinkProtocolV2, MavLinkPacketSignature } = mavlink;

/** Every kind of message of the dialects that Skein's table is made of, by id. */
export const KINDS = new Map(
  ['minimal', 'standard', 'common', 'uavionix', 'icarous', 'ardupilotmega'].flatMap((dialect) =>
    Object.values(mavlink[dialect].REGISTRY).map((kind) => [kind.MSG_ID, kind])));

const SIGNED_FLAG = 0x01;
// Where no frame had a time stamp before.
let signingTime = Date.now();

/** Writes frames over one link, counted for each sender. */
export class Writer {
  #counts = new Map();

  /** A frame; `signing`: {key, link, time} where it is signed, time in milliseconds. */
  frame(message, version, system, component, signing = null, flags = 0) {
    const sender = system * 256 + component;
    const count = this.#counts.get(sender) ?? 0;
    this.#counts.set(sender, (count + 1) & 255);
    if (version === 1) return new MavLinkProtocolV1(system, component).serialize(message, count);
    const protocol = new MavLinkProtocolV2(system, component, flags | (signing ? SIGNED_FLAG : 0));
    const frame = protocol.serialize(message, count);
    if (!signing) return frame;
    return protocol.sign(frame, signing.link, signing.key, signing.time ?? ++signingTime);
  }
}

/** Calls take(packet) for each frame in what is written into the stream that it returns. */
export function reader(take) {
  const stream = new PassThrough();
  mavlink.createMavLinkStream(stream).on('data', take);
  return stream;
}

// Sockets, all alike: {name, send(bytes), onBytes, isDatagram, close()}.

function datagrams(name, socket, to) {
  const link = {
    name, isDatagram: true, onBytes: () => {}, to,
    send: (bytes) => socket.send(bytes, link.to.port, link.to.address),
    close: () => socket.close(),
  };
  socket.on('message', (bytes, from) => {
    link.to ??= from;
    link.onBytes(bytes);
  });
  return link;
}

function stream(name, socket) {
  socket.setNoDelay(true);
  const link = {
    name, isDatagram: false, onBytes: () => {},
    send: (bytes) => socket.write(bytes),
    close: () => socket.destroy(),
  };
  socket.on('data', (bytes) => link.onBytes(bytes));
  socket.on('error', () => {});  // the other side has ended
  return link;
}

/** A socket that sends datagrams to a port of this machine. */
export async function udpClient(port) {
  const socket = dgram.createSocket('udp4');
  socket.bind(0, '127.0.0.1');
  await once(socket, 'listening');
  return datagrams('udp, Skein waits', socket, { port, address: '127.0.0.1' });
}

/** A socket that answers its first sender: [port, link]. */
export async function udpServer() {
  const socket = dgram.createSocket('udp4');
  socket.bind(0, '127.0.0.1');
  await once(socket, 'listening');
  return [socket.address().port, datagrams('udp, Skein sends first', socket)];
}

/** A connection to a port of this machine. */
export async function tcpClient(port) {
  const socket = net.connect(port, '127.0.0.1');
  await once(socket, 'connect');
  return stream('tcp, Skein waits', socket);
}

/** A port that takes one connection: [port, promise of the link]. */
export async function tcpServer() {
  const server = net.createServer();
  server.listen(0, '127.0.0.1');
  await once(server, 'listening');
  const link = once(server, 'connection').then(([socket]) => {
    server.close();
    return stream('tcp, Skein connects', socket);
  });
  return [server.address().port, link];
}
