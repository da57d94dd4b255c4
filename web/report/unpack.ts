// SPDX-License-Identifier: Apache-2.0
/** What the program has compressed (RFC 1950) and written in base64. */

export function bytes(packed: string): ArrayBuffer {
  const text = atob(packed),
    out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) out[i] = text.charCodeAt(i);
  return out.buffer;
}

export function unpacked(packed: string): Promise<ArrayBuffer> {
  const stream = new Blob([bytes(packed)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

/** The same of a text that stands in the page. */
export async function unpackedBlock(id: string): Promise<string> {
  return new TextDecoder().decode(await unpacked(document.getElementById(id)!.textContent ?? ""));
}
