// SPDX-License-Identifier: Apache-2.0
/**
 * Reads the server's binary messages: the wire form of docs/wire.md, by a table of its structs.
 *
 * A decoder is put together once for each type, from closures: the content security policy of the
 * page allows no code made from text. Values have the JSON form of records.ts.
 */

/**
 * A field: its name without unit, its type, and how its numbers are written.
 *
 * A type is one of
 *   flag u8 f32 f64 time uint int text vec2 vec3 quat
 *   @Struct   #Enumeration   |Choice
 * and what follows it is applied from the left: `?` optional, `[]` list, `[3]` array of three.
 */
export type Field = [name: string, type: string, suffix?: string, factor?: number, axes?: string, third_sign?: number];

/** An alternative of a choice: the word for it and its type. */
export type Alternative = [kind: string, type: string];

export interface Table {
  version: number;
  items: string; // the choice that a message is a list of
  structs: Record<string, Field[]>;
  enums: Record<string, string[]>;
  choices: Record<string, Alternative[]>;
}

/** Is given each item of a message: its kind, and the struct in its JSON form. */
export type Visit = (kind: string, value: unknown) => void;

type Value = unknown;
type Read = (reader: Reader) => Value;
type Put = (reader: Reader, object: Record<string, Value>) => void;

/** Reads from bytes; past their end it throws RangeError. */
export class Reader {
  at = 0;
  end = 0;
  private bytes = new Uint8Array(0);
  private view = new DataView(new ArrayBuffer(0));

  open(buffer: ArrayBuffer): void {
    this.bytes = new Uint8Array(buffer);
    this.view = new DataView(buffer);
    this.at = 0;
    this.end = buffer.byteLength;
  }
  private take(count: number): number {
    const from = this.at;
    if (from + count > this.end) throw new RangeError("it ends too early");
    this.at = from + count;
    return from;
  }
  octet(): number {
    return this.bytes[this.take(1)];
  }
  f32(): number {
    return this.view.getFloat32(this.take(4), true);
  }
  f64(): number {
    return this.view.getFloat64(this.take(8), true);
  }
  /** A 64-bit count of nanoseconds, in seconds: exact to the nanosecond for a century of runs. */
  time(): number {
    const from = this.take(8);
    const low = this.view.getUint32(from, true),
      high = this.view.getInt32(from + 4, true);
    const ns = high * 4294967296 + low;
    return Number.isSafeInteger(ns) ? ns / 1e9 : ns < 0 ? -Infinity : Infinity;
  }
  uint(): number {
    let value = 0,
      scale = 1;
    for (let k = 0; k < 10; ++k) {
      const octet = this.bytes[this.take(1)];
      value += (octet & 0x7f) * scale;
      if (octet < 0x80) return value;
      scale *= 128;
    }
    throw new RangeError("an integer is too large");
  }
  int(): number {
    const raw = this.uint();
    return raw % 2 === 0 ? raw / 2 : -(raw + 1) / 2;
  }
  private static readonly utf8 = new TextDecoder();
  text(): string {
    const count = this.uint(),
      from = this.take(count);
    return Reader.utf8.decode(this.bytes.subarray(from, from + count));
  }
  skip(count: number): void {
    this.take(count);
  }
}

/** `name` behind `prefix`, with an underscore where both say something. */
export function joined(prefix: string, name: string): string {
  return prefix && name ? `${prefix}_${name}` : prefix + name;
}

const finite = (value: number): number | null => (Number.isFinite(value) ? value : null);
const kDegrees = 180 / Math.PI;

/** Heading, roll and pitch [deg] of a rotation from body to north-east-down. */
export function attitude(w: number, x: number, y: number, z: number): [number, number, number] {
  const yaw = Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
  const roll = Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y));
  const pitch = Math.asin(Math.max(-1, Math.min(1, 2 * (w * y - z * x))));
  return [(yaw < 0 ? yaw + 2 * Math.PI : yaw) * kDegrees, roll * kDegrees, pitch * kDegrees];
}

/** Splits "@Name[][3]?" into its base and what is applied to it, the last first. */
function outermost(type: string): { inner: string; wrap: "" | "?" | "[]" | "[n]"; count: number } {
  if (type.endsWith("?")) return { inner: type.slice(0, -1), wrap: "?", count: 0 };
  const list = /\[(\d*)\]$/.exec(type);
  if (!list) return { inner: type, wrap: "", count: 0 };
  const inner = type.slice(0, list.index);
  return list[1] === "" ? { inner, wrap: "[]", count: 0 } : { inner, wrap: "[n]", count: Number(list[1]) };
}

/** Rows of numbers: a struct's scalar fields, one column each. */
export interface Columns {
  names: string[];
  words: (string[] | null)[]; // of enumerations
  width: number;
  /** Reads one struct into `out` from `at` on; what is not there is NaN, a word is its number. */
  read(reader: Reader, out: Float64Array, at: number): void;
}

export class Decoder {
  private readonly structs = new Map<string, Put[]>();
  private readonly items: { kind: string; read: Read }[];
  private readonly taken = new Map<string, (reader: Reader) => void>();
  private readonly reader = new Reader();

  constructor(private readonly table: Table) {
    this.items = table.choices[table.items].map(([kind, type]) => ({ kind, read: this.one(type) }));
  }

  /** From now on, items of this kind are handed over unread: for what comes too often to make objects of. */
  take(kind: string, reads: (reader: Reader) => void): void {
    this.taken.set(kind, reads);
  }

  /**
   * Calls `visit` for each item of a message, in order.
   * Throws: RangeError for bytes that make no sense, or are of another version.
   */
  decode(message: ArrayBuffer, visit: Visit): void {
    const r = this.reader;
    r.open(message);
    if (r.octet() !== this.table.version) throw new RangeError("the server speaks another version");
    for (let left = r.uint(); left > 0; --left) {
      const number = r.uint(),
        length = r.uint(),
        end = r.at + length,
        outer = r.end;
      if (end > outer) throw new RangeError("it ends too early");
      const known = this.items[number];
      if (known) {
        r.end = end;
        const takes = this.taken.get(known.kind);
        if (takes) takes(r);
        else if (known.kind === "live_record") this.visitRecord(known.read(r), visit);
        else visit(known.kind, known.read(r));
        r.end = outer;
      }
      r.at = end; // a kind or field that is not known is passed over
    }
  }

  // A record says itself what it is; one with a kind of its own stands under "value".
  private visitRecord(value: Value, visit: Visit): void {
    const { record } = value as { record: { kind: string; value?: unknown } };
    const inner = record.value;
    visit(record.kind, typeof inner === "object" && inner !== null ? inner : record);
  }

  private one(type: string): Read {
    const { inner, wrap, count } = outermost(type);
    if (wrap === "?") {
      const read = this.one(inner);
      return (r) => (r.octet() ? read(r) : null);
    }
    if (wrap) {
      const read = this.one(inner);
      return (r) => {
        const n = wrap === "[]" ? r.uint() : count;
        if (n > r.end - r.at) throw new RangeError("a list is longer than what is there");
        const list: Value[] = new Array(n);
        for (let i = 0; i < n; ++i) list[i] = read(r);
        return list;
      };
    }
    if (type[0] === "@") {
      const name = type.slice(1);
      return (r) => this.struct(name, r, {});
    }
    if (type[0] === "#") {
      const words = this.table.enums[type.slice(1)];
      return (r) => words[r.octet()] ?? "";
    }
    if (type[0] === "|") return this.choice(type.slice(1));
    switch (type) {
      case "flag":
        return (r) => r.octet() === 1;
      case "u8":
        return (r) => r.octet();
      case "f32":
        return (r) => finite(r.f32());
      case "f64":
        return (r) => finite(r.f64());
      case "time":
        return (r) => r.time();
      case "uint":
        return (r) => r.uint();
      case "int":
        return (r) => r.int();
      case "text":
        return (r) => r.text();
      case "vec2":
        return (r) => [finite(r.f64()), finite(r.f64())];
      case "vec3":
        return (r) => [finite(r.f64()), finite(r.f64()), finite(r.f64())];
      default:
        throw new Error(`the wire table has an unknown type: ${type}`);
    }
  }

  private struct(name: string, r: Reader, object: Record<string, Value>): Record<string, Value> {
    const length = r.uint(),
      outer = r.end,
      end = r.at + length;
    if (end > outer) throw new RangeError("it ends too early");
    r.end = end;
    for (const put of this.fields(name)) {
      if (r.at >= end) break; // an older sender
      put(r, object);
    }
    r.at = end;
    r.end = outer;
    return object;
  }

  private fields(name: string, prefix = ""): Put[] {
    const key = `${name} ${prefix}`;
    let made = this.structs.get(key);
    if (!made) {
      const fields = this.table.structs[name];
      if (!fields) throw new Error(`the wire table has no struct ${name}`);
      made = fields.map((field) => this.put(field, prefix));
      this.structs.set(key, made);
    }
    return made;
  }

  private put([own, type, suffix = "", factor = 1, axes = "", third = 1]: Field, prefix: string): Put {
    const name = joined(prefix, own);
    const { inner, wrap, count } = outermost(type);
    if (wrap === "?") {
      const put = this.put([own, inner, suffix, factor, axes, third], prefix);
      const missing = inner === "time" ? joined(name, "s") : /^[@|]|^vec|^quat/.test(inner) ? name : name + suffix;
      return (r, object) => {
        if (r.octet()) put(r, object);
        else object[missing] = null;
      };
    }
    if (wrap === "[n]") {
      const puts = Array.from({ length: count }, (_, k) => this.put([joined(own, String(k + 1)), inner, suffix, factor, axes, third], prefix));
      return (r, object) => {
        for (const put of puts) put(r, object);
      };
    }
    if (wrap === "[]") {
      const read = this.one(type),
        key = name + suffix;
      return (r, object) => {
        object[key] = read(r);
      };
    }
    if (type === "vec2" || type === "vec3") {
      const names = axes.split(" ").map((axis) => joined(name, axis) + suffix);
      const last = third * factor;
      return (r, object) => {
        object[names[0]] = finite(r.f64() * factor);
        object[names[1]] = finite(r.f64() * factor);
        if (type === "vec3") object[names[2]] = finite(r.f64() * last);
      };
    }
    if (type === "quat") {
      const names = ["heading_deg", "roll_deg", "pitch_deg"].map((angle) => joined(name, angle));
      return (r, object) => {
        const angles = attitude(r.f64(), r.f64(), r.f64(), r.f64());
        for (let k = 0; k < 3; ++k) object[names[k]] = angles[k];
      };
    }
    if (type === "time") {
      const key = joined(name, "s");
      return (r, object) => {
        object[key] = r.time();
      };
    }
    if (type[0] === "@") {
      const struct = type.slice(1);
      return (r, object) => this.nested(struct, name, r, object);
    }
    if (type[0] === "|") {
      const read = this.choice(type.slice(1));
      if (!name)
        return (r, object) => {
          Object.assign(object, read(r));
        };
      return (r, object) => {
        object[name] = read(r);
      };
    }
    const key = name + suffix;
    if (type === "f64")
      return (r, object) => {
        object[key] = finite(r.f64() * factor);
      };
    const read = this.one(type);
    return (r, object) => {
      object[key] = read(r);
    };
  }

  private nested(struct: string, prefix: string, r: Reader, object: Record<string, Value>): void {
    const length = r.uint(),
      outer = r.end,
      end = r.at + length;
    if (end > outer) throw new RangeError("it ends too early");
    r.end = end;
    for (const put of this.fields(struct, prefix)) {
      if (r.at >= end) break;
      put(r, object);
    }
    r.at = end;
    r.end = outer;
  }

  private choice(name: string): Read {
    const reads = this.table.choices[name].map(([kind, type]) => this.alternative(kind, type));
    return (r) => {
      const number = r.uint(),
        length = r.uint(),
        end = r.at + length,
        outer = r.end;
      if (end > outer) throw new RangeError("it ends too early");
      r.end = end;
      const value = reads[number] ? reads[number](r) : { kind: "" };
      r.at = end;
      r.end = outer;
      return value;
    };
  }

  // A struct's fields stand beside the kind; a struct that has a kind of its own stands under
  // "value", a bare list under "points".
  private alternative(kind: string, type: string): Read {
    if (type[0] !== "@" || type.endsWith("]")) {
      const read = this.one(type);
      return (r) => ({ kind, points: read(r) });
    }
    const struct = type.slice(1);
    if (this.table.structs[struct]?.some(([field, of]) => field === "kind" || (field === "" && of[0] === "|")))
      return (r) => ({ kind, value: this.struct(struct, r, {}) });
    return (r) => this.struct(struct, r, { kind });
  }

  /** The scalar fields of a struct as columns of numbers, by their JSON names. */
  columns(struct: string): Columns {
    const names: string[] = [];
    const words: (string[] | null)[] = [];
    const reads: ((r: Reader, out: Float64Array, at: number) => void)[] = [];
    const add = (name: string, read: (r: Reader) => number) => {
      const column = names.push(name) - 1;
      reads.push((r, out, at) => {
        out[at + column] = read(r);
      });
    };
    for (const [own, type, suffix = "", factor = 1, axes = "", third = 1] of this.table.structs[struct] ?? []) {
      const optional = type.endsWith("?"),
        base = optional ? type.slice(0, -1) : type;
      const name = base === "time" ? joined(own, "s") : own + suffix;
      if (base === "vec2" || base === "vec3") {
        const first = names.length,
          n = base === "vec3" ? 3 : 2;
        for (let k = 0; k < n; ++k) names.push(joined(own, axes.split(" ")[k]) + suffix);
        reads.push((r, out, at) => {
          const there = !optional || r.octet() === 1;
          for (let k = 0; k < n; ++k) out[at + first + k] = there ? r.f64() * factor * (k === 2 ? third : 1) : NaN;
        });
        continue;
      }
      const scalar = this.scalar(base, factor);
      words[names.length] = base[0] === "#" ? this.table.enums[base.slice(1)] : null;
      add(name, optional ? (r) => (r.octet() === 1 ? scalar(r) : NaN) : scalar);
    }
    return {
      names,
      words,
      width: names.length,
      read: (r, out, at) => {
        const length = r.uint(),
          outer = r.end,
          end = r.at + length;
        if (end > outer) throw new RangeError("it ends too early");
        r.end = end;
        out.fill(NaN, at, at + names.length);
        for (const read of reads) {
          if (r.at >= end) break;
          read(r, out, at);
        }
        r.at = end;
        r.end = outer;
      },
    };
  }

  private scalar(type: string, factor: number): (r: Reader) => number {
    if (type[0] === "#" || type === "flag" || type === "u8") return (r) => r.octet();
    switch (type) {
      case "f32":
        return (r) => r.f32() * factor;
      case "f64":
        return (r) => r.f64() * factor;
      case "time":
        return (r) => r.time();
      case "uint":
        return (r) => r.uint();
      case "int":
        return (r) => r.int();
      default:
        throw new Error(`a ${type} is no column of numbers`);
    }
  }
}
