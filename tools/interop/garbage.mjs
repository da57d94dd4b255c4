// SPDX-License-Identifier: Apache-2.0
// Bytes between frames that are none: noise, frames that break off, frames with a wrong byte.
const MAGIC_1 = 0xfe, MAGIC_2 = 0xfd;

/** Pseudo-random whole numbers below a bound, the same ones each time. */
export function dice(seed) {
  let state = seed >>> 0;
  return (bound) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * bound);
  };
}

function block(frame, roll) {
  switch (roll(5)) {
    case 0:
      return Buffer.from(Array.from({ length: 1 + roll(40) }, () => roll(256)));
    case 1:
      return Buffer.from([MAGIC_2, 255, 0, 0, roll(256), roll(256), 1, roll(150), 0, 0]);
    case 2:
      return Buffer.from([MAGIC_1, 255, roll(256), roll(256), 1, roll(150)]);
    case 3:
      return frame.subarray(0, 1 + roll(frame.length - 1));
    default: {
      const broken = Buffer.from(frame);
      broken[1 + roll(broken.length - 1)] ^= 1 + roll(255);
      return broken;
    }
  }
}

// Where a frame of an unknown kind could begin. Its CRC cannot be checked, so any receiver
// has to take it for a frame if another one follows it.
function isUncheckable(bytes, at, knownIds) {
  const header = bytes.subarray(at, at + 10);
  if (header[0] !== MAGIC_1 && header[0] !== MAGIC_2) return false;
  if (header.length < 10) return true;  // it may become one
  if (header[0] === MAGIC_1) return !knownIds.has(header[5]);
  return header[2] <= 1 && !knownIds.has(header.readUIntLE(7, 3));
}

/**
 * Frames with garbage before each: [bytes, number of bytes that are garbage]. A receiver that
 * goes on one byte behind each false begin finds every frame.
 */
export function withGarbage(frames, knownIds, roll) {
  const parts = frames.flatMap((frame) => [block(frame, roll), frame]);
  const bytes = Buffer.concat(parts);
  let end = bytes.length, count = 0;
  for (let i = parts.length - 1; i >= 0; --i) {
    const begin = end - parts[i].length;
    const isGarbage = i % 2 === 0;
    if (isGarbage) {
      count += parts[i].length;
      for (let at = end - 1; at >= begin; --at)
        if (isUncheckable(bytes, at, knownIds)) bytes[at] = 0;
    }
    end = begin;
  }
  return [bytes, count];
}
