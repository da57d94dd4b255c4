// SPDX-License-Identifier: Apache-2.0
/** The WebSocket to the server: connects again after it was lost, numbers commands and follows their fate. */
import type { CommandReply } from "../common/protocol";
import type { Decoder, Visit } from "../common/wire";

export type ConnectionState = "connecting" | "open" | "lost";

export interface Sent {
  number: number;
  text: string; // for people
  state: "pending" | "given" | "accepted" | "refused" | "lost";
  reason: string;
  since: number; // wall clock [s]
  settled?: (sent: Sent) => void; // told whenever its state changes
}

const kFirstWait = 0.5,
  kLongestWait = 10; // [s]
const kProtocol = "skein.live.v1";

export class Connection {
  state: ConnectionState = "connecting";
  /** Newest first; the oldest are dropped. */
  readonly sent: Sent[] = [];
  bytes = 0;
  /** Wall clock of the next try [s]; 0 while connected. */
  nextTry = 0;
  onState: () => void = () => undefined;
  onSent: (sent: Sent) => void = () => undefined;
  /** The server is there again, but it may be another run: asked before the socket is opened. */
  beforeOpen: () => Promise<boolean> = async () => true;
  private socket: WebSocket | null = null;
  private wait = kFirstWait;
  private lastNumber = 0;
  private timer = 0;

  constructor(
    private readonly url: string,
    private readonly decoder: Decoder,
    private readonly visit: Visit,
  ) {}

  open(): void {
    clearTimeout(this.timer);
    this.nextTry = 0;
    const socket = new WebSocket(this.url, kProtocol);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      this.wait = kFirstWait;
      this.set("open");
    };
    socket.onmessage = (event) => {
      if (!(event.data instanceof ArrayBuffer)) return;
      this.bytes += event.data.byteLength;
      try {
        this.decoder.decode(event.data, this.visit);
      } catch (problem) {
        // One message that makes no sense is left; a server that speaks otherwise ends the connection.
        console.warn("a message could not be read", problem);
      }
    };
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.socket = null;
      this.loseSent();
      this.set("lost");
      this.again();
    };
  }

  private again(): void {
    const wait = this.wait * (0.8 + 0.4 * Math.random()); // not all clients at the same moment
    this.wait = Math.min(kLongestWait, this.wait * 1.7);
    this.nextTry = performance.now() / 1000 + wait;
    this.timer = window.setTimeout(() => {
      this.beforeOpen().then(
        (there) => (there ? this.open() : this.again()),
        () => this.again(),
      );
    }, 1000 * wait);
  }

  private set(state: ConnectionState): void {
    this.state = state;
    this.onState();
  }

  private loseSent(): void {
    for (const each of this.sent) if (each.state === "pending" || each.state === "given") this.settle(each, "lost", "");
  }

  private settle(each: Sent, state: Sent["state"], reason: string): void {
    each.state = state;
    each.reason = reason;
    each.settled?.(each);
    this.onSent(each);
  }

  /** Sends a message (without its number); `text` says to people what it asks for. */
  send(message: Record<string, unknown>, text: string, settled?: (sent: Sent) => void): Sent {
    const each: Sent = { number: ++this.lastNumber, text, state: "pending", reason: "", since: performance.now() / 1000, settled };
    this.sent.unshift(each);
    if (this.sent.length > 100) this.sent.pop();
    if (this.socket?.readyState === WebSocket.OPEN) {
      this.socket.send(JSON.stringify({ number: each.number, ...message }));
      this.onSent(each);
    } else {
      this.settle(each, "lost", "");
    }
    return each;
  }

  reply(reply: CommandReply): void {
    const each = this.sent.find((sent) => sent.number === reply.number);
    if (each) this.settle(each, reply.state, reply.text);
  }
}
