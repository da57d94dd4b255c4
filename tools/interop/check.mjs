// SPDX-License-Identifier: Apache-2.0
// Checks that count, and waiting that ends.
let wrong = 0;
const MAX_SHOWN = 20;

/** Notes that something is not as it must be. */
export function complain(text) {
  if (++wrong <= MAX_SHOWN) console.log(`WRONG: ${text}`);
}

export function check(condition, text) {
  if (!condition) complain(text);
  return condition;
}

export function checkEqual(found, expected, text) {
  return check(found === expected, `${text}: ${found}, not ${expected}`);
}

/** Waits for a condition, not for ever. */
export async function until(condition, text, seconds = 20) {
  const end = Date.now() + 1000 * seconds;
  while (!condition()) {
    if (Date.now() > end) throw new Error(`${text}: waited for ${seconds} s in vain`);
    await new Promise((resolve) => setTimeout(resolve, 2));
  }
}

/** Ends the script: 1 when something was wrong. */
export function finish() {
  console.log(wrong === 0 ? 'all is right' : `${wrong} things are wrong`);
  process.exit(wrong === 0 ? 0 : 1);
}
