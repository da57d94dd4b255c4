// SPDX-License-Identifier: Apache-2.0
/** Asks for the token; the server keeps it in a cookie that scripts cannot read. */
import { h } from "../common/dom";
import { T } from "../common/texts";
import { labelledField, setText } from "../common/ui";

export function login(root: HTMLElement): Promise<void> {
  return new Promise((resolve) => {
    const token = h("input", { type: "password", autocomplete: "current-password", required: true });
    const problem = h("p", { class: "problem", role: "alert" });
    const form = h(
      "form",
      {
        class: "login",
        onsubmit: (event) => {
          event.preventDefault();
          void enter();
        },
      },
      h("h1", {}, T.login.title),
      h("p", { class: "hint" }, T.login.why),
      labelledField(T.login.label, token),
      problem,
      h("button", { type: "submit", class: "primary" }, T.login.enter),
    );
    const enter = async () => {
      const response = await fetch("login", {
        method: "POST",
        headers: { "Content-Type": "application/json" },
        body: JSON.stringify({ token: token.value }),
      }).catch(() => null);
      if (response?.ok) return resolve();
      setText(problem, T.login.refused);
      token.select();
    };
    root.replaceChildren(h("main", { class: "start" }, form));
    token.focus();
  });
}
