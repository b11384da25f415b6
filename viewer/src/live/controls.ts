/** What the reader sets beside the picture: material, mold, grippers by numbers. */

import { byId, make } from "../page/dom";
import { gripperName } from "../data/page_data";
import { along, fit, GRID, KINDS, moved, RANGES, RULES, type Range, type Setup } from "./setup";
import { MATERIALS, properties } from "./materials";

const NAMES: Record<string, string> = {
  plane: "Plane",
  cylinder: "Cylinder",
  sphere: "Dome",
  saddle: "Saddle",
  "min-force": "Least forces (the paper's)",
  "moment-balance": "Balanced moments",
};

/** Positions of a slider. */
const STOPS = 400;

/** Where on a slider a value is, 0 to 1. */
function shareOf({ low, high, ratios }: Range, value: number): number {
  return ratios ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
}

function valueAt(range: Range, share: number): number {
  const { low, high, ratios } = range;
  return fit(range, ratios ? low * (high / low) ** share : low + share * (high - low));
}

export interface Controls {
  /** Shows a setup. */
  show: (setup: Setup) => void;
}

/**
 * Links the controls. `want` hears of every change, and whether it is one of a slider under way; `let_go` when a slider is let go.
 */
export function linkControls(
  current: () => Setup,
  want: (setup: Setup) => void,
  letGo: () => void,
): Controls {
  const parts: ((setup: Setup) => void)[] = [];

  const material = byId<HTMLSelectElement>("material");
  for (const [key, { label }] of Object.entries(MATERIALS))
    material.append(make("option", { value: key }, label));
  material.addEventListener("change", () => {
    want({ ...current(), material: material.value });
    letGo();
  });
  parts.push((setup) => (material.value = setup.material));

  const segments = (id: "kind" | "slopes", values: readonly string[]) => {
    const host = byId(id);
    for (const value of values) {
      const input = make("input", { type: "radio", name: id, value });
      host.append(make("label", {}, input, make("span", {}, NAMES[value]!)));
      input.addEventListener("change", () => {
        want({ ...current(), [id]: value });
        letGo();
      });
      parts.push((setup) => (input.checked = setup[id] === value));
    }
  };
  segments("kind", KINDS);
  segments("slopes", RULES);

  const slider = (
    id: string,
    shown: (setup: Setup) => [number, string],
    change: (share: number) => Setup,
  ) => {
    const input = byId<HTMLInputElement>(id);
    const output = byId<HTMLOutputElement>(`${id}-value`);
    input.max = String(STOPS);
    input.addEventListener("input", () => want(change(Number(input.value) / STOPS)));
    input.addEventListener("change", letGo);
    parts.push((setup) => {
      const [share, text] = shown(setup);
      if (document.activeElement !== input || !input.matches(":active"))
        input.value = String(Math.round(share * STOPS));
      if (output.textContent === text) return;
      output.textContent = text;
      input.setAttribute("aria-valuetext", text);
    });
  };
  const ofRange = (key: Range["key"], text: (setup: Setup) => string) => {
    const range = RANGES[key];
    slider(
      key,
      (setup) => [shareOf(range, setup[key]), text(setup)],
      (share) => ({ ...current(), [key]: valueAt(range, share) }),
    );
  };
  const ofMaterial = ({ material, mass, rigidity }: Setup) => properties(material, mass, rigidity);
  ofRange("mass", (setup) => ofMaterial(setup).mass);
  ofRange("rigidity", (setup) => ofMaterial(setup).rigidity);
  ofRange("height", ({ height }) => `${height} mm`);
  ofRange("radius", ({ radius }) => `${radius} mm`);
  ofRange("tilt", ({ tilt }) => `${tilt}°`);
  parts.push(({ kind }) => {
    byId("radius").closest("label")!.hidden = kind === "plane";
    byId("tilt").closest("label")!.hidden = kind !== "plane";
  });
  slider(
    "along",
    (setup) => {
      const share = shareAlong(setup);
      return share === null ? [0, "moved by hand"] : [share, `${Math.round(100 * share)} %`];
    },
    (share) => ({ ...current(), grippers: along(share) }),
  );

  const gripper = byId<HTMLSelectElement>("gripper");
  for (let k = 0; k < GRID[0] * GRID[1]; k++) {
    const name = gripperName([k % GRID[0], Math.floor(k / GRID[0])]);
    gripper.append(make("option", { value: String(k) }, name));
  }
  const fields = ["x", "y", "z"].map((axis, c) => {
    const input = byId<HTMLInputElement>(`gripper-${axis}`);
    input.addEventListener("change", () => {
      const k = Number(gripper.value);
      const place = [...current().grippers[k]!] as [number, number, number];
      place[c] = Number(input.value) / 1000;
      if (Number.isFinite(place[c])) want(moved(current(), k, place));
      letGo();
    });
    return input;
  });
  const showPlace = (setup: Setup) => {
    const place = setup.grippers[Number(gripper.value)]!;
    fields.forEach((input, c) => (input.value = String(Math.round(place[c]! * 1e5) / 100)));
  };
  gripper.addEventListener("change", () => showPlace(current()));
  parts.push(showPlace);

  return { show: (setup) => parts.forEach((part) => part(setup)) };
}

/** How far along the paper's motion the grippers are; null if they were moved by hand. */
function shareAlong({ grippers }: Setup): number | null {
  const height = (at: number) => along(at)[0]![2];
  const share = Math.round((STOPS * (grippers[0]![2] - height(0))) / (height(1) - height(0))) / STOPS;
  return JSON.stringify(along(share)) === JSON.stringify(grippers) ? share : null;
}
