// SPDX-License-Identifier: Apache-2.0
// Elements of the page. Texts stay texts, whatever they hold.

type Child = Node | string;

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

/** A name that may break behind its underscores. */
export function breakable(name: string): HTMLElement {
  const made = element("span");
  name.split(/(?<=_)/).forEach((part, i) => made.append(...(i > 0 ? [element("wbr")] : []), part));
  return made;
}

export function button(text: string, name: string, act: () => void): HTMLButtonElement {
  const made = element("button", { type: "button", "aria-label": name }, text);
  made.addEventListener("click", act);
  return made;
}

export function checkbox(checked: boolean, change: (checked: boolean) => void): HTMLInputElement {
  const made = element("input", { type: "checkbox" });
  made.checked = checked;
  made.addEventListener("change", () => change(made.checked));
  return made;
}

export interface Range {
  least: number;
  most: number;
  step: number;
  value: number;
}

export function slider(name: string, range: Range, change: (value: number) => void) {
  const made = element("input", {
    type: "range",
    "aria-label": name,
    min: String(range.least),
    max: String(range.most),
    step: String(range.step),
  });
  made.value = String(range.value);
  made.addEventListener("input", () => change(Number(made.value)));
  return made;
}

export function choice(names: string[], change: (index: number) => void): HTMLSelectElement {
  const made = element("select");
  names.forEach((name, i) => made.append(element("option", { value: String(i) }, name)));
  made.addEventListener("change", () => change(made.selectedIndex));
  return made;
}

/** Four digits at most, as a reader wants them. */
export function readable(value: number): string {
  return String(Number(value.toPrecision(4)));
}
