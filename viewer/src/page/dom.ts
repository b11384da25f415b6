/** Small helpers to make and find elements. */

type Child = Node | string;

/** An element with attributes and children. `class`, `text` and ARIA attributes are given by their names. */
export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

/** Gives an element these children; one that is there already as it shall be stays, and the browser need not lay it out anew. */
export function renew(element: HTMLElement, children: Child[]): void {
  children.forEach((child, k) => {
    const now = element.childNodes[k];
    const next = typeof child === "string" ? document.createTextNode(child) : child;
    if (now === undefined) element.append(next);
    else if (!now.isEqualNode(next)) now.replaceWith(next);
  });
  while (element.childNodes.length > children.length) element.lastChild!.remove();
}

/** The element with an id; the template holds it. */
// eslint-disable-next-line @typescript-eslint/no-unnecessary-type-parameters -- the template holds the type
export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const element = document.getElementById(id);
  if (element === null) throw new Error(`the page has no element “${id}”`);
  return element as T;
}

/** Lets the picture know how high the head is, which wraps where a title is long: picture and play bar fill the rest of the window. */
export function measureHead(): void {
  const head = document.querySelector<HTMLElement>(".head");
  if (head === null) return;
  const tell = (): void => document.documentElement.style.setProperty("--head", `${head.offsetHeight}px`);
  new ResizeObserver(tell).observe(head);
  tell();
}

/** A CSS color variable of the theme in force. */
export function themeColor(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
