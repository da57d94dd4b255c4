// SPDX-License-Identifier: Apache-2.0
// What the pages' TypeScript is looked over for: the recommended rules that need no types.
import tseslint from "../tools/web_lint/node_modules/typescript-eslint/dist/index.js";

export default tseslint.config(
  // Made by `skein schema`.
  { ignores: ["common/records.ts", "common/wire_table.ts"] },
  ...tseslint.configs.recommended,
  {
    rules: {
      "@typescript-eslint/no-unused-vars": ["error", { argsIgnorePattern: "^_" }],
      "@typescript-eslint/no-unused-expressions": ["error", { allowShortCircuit: true, allowTernary: true }],
      eqeqeq: ["error", "smart"],
      "no-var": "error",
      "prefer-const": "error",
    },
  },
);
