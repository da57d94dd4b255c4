// SPDX-License-Identifier: Apache-2.0
/** Writes the wire form from values in their JSON form: for tests and servers that pretend. */
import { joined, type Field, type Table } from "../common/wire";

type Json = any; // eslint-disable-line

class Writer {
  readonly bytes: number[] = [];
  uint(value: number): void {
    while (value >= 128) {
      this.bytes.push((value % 128) | 128);
      value = Math.floor(value / 128);
    }
    this.bytes.push(value);
  }
  raw(size: number, set: (view: DataView) => void): void {
    const view = new DataView(new ArrayBuffer(size));
    set(view);
    for (let i = 0; i < size; ++i) this.bytes.push(view.getUint8(i));
  }
  f64(value: number | null | undefined): void {
    this.raw(8, (v) => v.setFloat64(0, value ?? NaN, true));
  }
  f32(value: number | null | undefined): void {
    this.raw(4, (v) => v.setFloat32(0, value ?? NaN, true));
  }
  part(inner: Writer): void {
    this.uint(inner.bytes.length);
    for (const b of inner.bytes) this.bytes.push(b);
  }
}

export class Encoder {
  constructor(private readonly table: Table) {}

  /** A message of items, each an object with its kind. */
  message(items: Json[]): Uint8Array {
    const w = new Writer();
    w.bytes.push(this.table.version);
    w.uint(items.length);
    const own = this.table.choices[this.table.items];
    for (const item of items)
      // what is no item of its own is a record
      this.choice(w, this.table.items, own.some(([kind]) => kind === item.kind) ? item : { kind: "live_record", record: item });
    return Uint8Array.from(w.bytes);
  }

  private ownKind(struct: string): boolean {
    return this.table.structs[struct].some(([name, type]) => name === "kind" || (name === "" && type[0] === "|"));
  }

  private choice(w: Writer, name: string, value: Json): void {
    const all = this.table.choices[name];
    const index = all.findIndex(([kind]) => kind === value.kind);
    if (index < 0) throw new Error(`${name} has no ${value.kind}`);
    const type = all[index][1],
      inner = new Writer();
    if (type[0] === "@" && !type.endsWith("]")) this.struct(inner, type.slice(1), "", this.ownKind(type.slice(1)) ? value.value : value);
    else this.one(inner, type, value.points);
    w.uint(index);
    w.part(inner);
  }

  private struct(w: Writer, name: string, prefix: string, value: Json): void {
    const inner = new Writer();
    for (const field of this.table.structs[name]) this.field(inner, field, prefix, value);
    w.part(inner);
  }

  private field(w: Writer, [own, type, suffix = "", factor = 1, axes = "", third = 1]: Field, prefix: string, o: Json): void {
    const name = joined(prefix, own);
    if (type.endsWith("?")) {
      const inner = type.slice(0, -1);
      const key = inner === "time" ? joined(name, "s") : name + suffix;
      const there = o[key] != null;
      w.bytes.push(there ? 1 : 0);
      if (there) this.field(w, [own, inner, suffix, factor, axes, third], prefix, o);
      return;
    }
    const array = /^(.*)\[(\d+)\]$/.exec(type);
    if (array) {
      for (let k = 1; k <= Number(array[2]); ++k) this.field(w, [joined(own, String(k)), array[1], suffix, factor, axes, third], prefix, o);
      return;
    }
    if (type === "vec2" || type === "vec3") {
      axes
        .split(" ")
        .slice(0, type === "vec2" ? 2 : 3)
        .forEach((axis, k) => {
          const v = o[joined(name, axis) + suffix];
          w.f64(v == null ? NaN : (v / factor) * (k === 2 ? third : 1));
        });
    } else if (type === "time") {
      this.one(w, type, o[joined(name, "s")]);
    } else if (type[0] === "@" && !type.endsWith("]")) {
      this.struct(w, type.slice(1), name, o);
    } else if (type[0] === "|") {
      this.choice(w, type.slice(1), name ? o[name] : o);
    } else if (type === "f64") {
      const v = o[name + suffix];
      w.f64(v == null ? NaN : v / factor);
    } else {
      this.one(w, type, o[name + suffix]);
    }
  }

  private one(w: Writer, type: string, value: Json): void {
    if (type.endsWith("[]")) {
      const list = value ?? [];
      w.uint(list.length);
      for (const item of list) this.one(w, type.slice(0, -2), item);
    } else if (type[0] === "@") {
      this.struct(w, type.slice(1), "", value);
    } else if (type[0] === "#") {
      w.bytes.push(Math.max(0, this.table.enums[type.slice(1)].indexOf(value)));
    } else if (type[0] === "|") {
      this.choice(w, type.slice(1), value);
    } else if (type === "flag") {
      w.bytes.push(value ? 1 : 0);
    } else if (type === "u8") {
      w.bytes.push(value ?? 0);
    } else if (type === "f64") {
      w.f64(value);
    } else if (type === "f32") {
      w.f32(value);
    } else if (type === "time") {
      w.raw(8, (v) => v.setBigInt64(0, BigInt(Math.round((value ?? 0) * 1e9)), true));
    } else if (type === "uint") {
      w.uint(value ?? 0);
    } else if (type === "text") {
      const bytes = new TextEncoder().encode(value ?? "");
      w.uint(bytes.length);
      for (const b of bytes) w.bytes.push(b);
    } else if (type === "vec2") {
      w.f64(value[0]);
      w.f64(value[1]);
    } else {
      throw new Error(`no way to write ${type}`);
    }
  }
}
