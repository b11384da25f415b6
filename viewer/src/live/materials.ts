/** The materials that come with plydrape, as their files say them, with mass and rigidity changed by factors. */

import cao from "../../../crates/plydrape-io/materials/cao2008_plain.toml";
import krogh from "../../../crates/plydrape-io/materials/krogh2018.toml";
import cottonTwill from "../../../crates/plydrape-io/materials/petrak2025_cotton_twill.toml";
import polyesterPlain from "../../../crates/plydrape-io/materials/petrak2025_polyester_plain.toml";
import polyesterTwill from "../../../crates/plydrape-io/materials/petrak2025_polyester_twill.toml";
import { short } from "../data/number";

/** Name, what the reader chooses by, and the file. */
export const MATERIALS: Record<string, { label: string; file: string }> = {
  krogh2018: { label: "Carbon prepreg of the paper (krogh2018)", file: krogh },
  cao2008_plain: { label: "Glass and polypropylene, plain (cao2008_plain)", file: cao },
  petrak2025_cotton_twill: { label: "Cotton cloth, twill (petrak2025_cotton_twill)", file: cottonTwill },
  petrak2025_polyester_plain: {
    label: "Polyester cloth, plain (petrak2025_polyester_plain)",
    file: polyesterPlain,
  },
  petrak2025_polyester_twill: {
    label: "Polyester cloth, twill (petrak2025_polyester_twill)",
    file: polyesterTwill,
  },
};

/** A quantity of a material's file: its key, its number and its unit. */
const QUANTITY = /^(mass|flexural_rigidity|bending_rigidity_warp|bending_rigidity_weft) = "(\S+) ([^"]+)"$/;

/** A number with four digits that a scene can hold. */
const number = (value: number): string => String(Number(value.toPrecision(4)));

/** Mass and rigidities of a material times the factors, each with its unit. */
export function properties(name: string, mass: number, rigidity: number): { mass: string; rigidity: string } {
  const found = MATERIALS[name]!.file.split("\n").flatMap((line) => {
    const match = QUANTITY.exec(line);
    return match === null ? [] : [{ key: match[1]!, value: Number(match[2]), unit: match[3]! }];
  });
  const of = (wanted: (key: string) => boolean, factor: number) => {
    const parts = found.filter(({ key }) => wanted(key));
    return `${parts.map(({ value }) => short(value * factor)).join(" / ")} ${parts[0]?.unit ?? ""}`;
  };
  const readable = (text: string) =>
    text.replace("N m^2", "N·m²").replace("N m", "N·m").replace("g/m^2", "g/m²");
  return {
    mass: readable(of((key) => key === "mass", mass)),
    rigidity: readable(of((key) => key !== "mass", rigidity)),
  };
}

/** What a scene says of a material under `[ply]`: its name, or its keys with mass and rigidity changed. */
export function inScene(name: string, mass: number, rigidity: number): string[] {
  if (mass === 1 && rigidity === 1) return [`material = "${name}"`];
  const changed = MATERIALS[name]!.file.split("\n")
    .filter((line) => line !== "" && !line.startsWith("#"))
    .map((line) => {
      const match = QUANTITY.exec(line);
      if (match !== null) {
        const factor = match[1] === "mass" ? mass : rigidity;
        return `${match[1]!} = "${number(Number(match[2]) * factor)} ${match[3]!}"`;
      }
      return line
        .replace(/^name = "(.*)"$/, 'name = "$1, changed"')
        .replace(
          /^source = "/,
          `source = "mass times ${number(mass)} and rigidity times ${number(rigidity)} of: `,
        )
        .replace(/^\[(.*)\]$/, "[ply.material.$1]");
    });
  return ["", "[ply.material]", ...changed];
}
