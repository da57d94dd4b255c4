// SPDX-License-Identifier: Apache-2.0
// The little of Node that the tests use; its types are no dependency of the page.
declare module "node:test" {
  export function test(name: string, body: () => void | Promise<void>): void;
}
declare module "node:assert/strict" {
  interface Assert {
    equal(actual: unknown, expected: unknown, message?: string): void;
    deepEqual(actual: unknown, expected: unknown, message?: string): void;
    ok(value: unknown, message?: string): asserts value;
    throws(body: () => void, error?: unknown, message?: string): void;
    match(text: string, pattern: RegExp): void;
    fail(message?: string): never;
  }
  const assert: Assert;
  export default assert;
}
