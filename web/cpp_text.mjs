// SPDX-License-Identifier: Apache-2.0
// Text as C++ text. Literals end at 64 kB in some compilers: pieces are joined by the compiler.
export function literal(text) {
  if (text.includes(')skein_"')) throw new Error("the text contains the literal's end");
  const pieces = [];
  for (let i = 0; i < text.length; i += 8000) pieces.push(`R"skein_(${text.slice(i, i + 8000)})skein_"`);
  return pieces.join("\n    ");
}

/** A function that returns the text. */
export function textFunction(name, text) {
  return `std::string_view ${name}() {
  static constexpr char text[] =
    ${literal(text)};
  return {text, sizeof text - 1};
}
`;
}
