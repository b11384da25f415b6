/** A second result, from a file that the reader chooses: its page, which can be drawn, or its result.json, whose limits can be compared. */

import { Motion } from "./motion";
import { BrokenData, readPageData, type Limit } from "./page_data";

/** A limit and how it was kept, as pages and results hold it. */
export type OtherLimit = Pick<Limit, "name" | "value" | "limit" | "unit" | "ok">;

export interface Other {
  title: string;
  accepted: boolean;
  /** In which world, as it follows the word accepted. */
  world: string;
  /** The limits of the model that decides. */
  limits: OtherLimit[];
  /** Steps and time of the motion (s). */
  steps: number;
  duration: number;
  /** What can be drawn; null of a result.json. */
  motion: Motion | null;
}

/** What surrounds the data in a page. */
const START = /<script type="application\/json" id="plydrape-data">/;
const END = "</script>";

/**
 * Reads a page, or a result of the version that this page belongs to, from its text; the message of what it throws is a sentence for
 * the reader.
 */
export async function readOther(text: string, version: number): Promise<Other> {
  const start = START.exec(text);
  if (start === null) return ofResult(text, version);
  const from = start.index + start[0].length;
  const data = readPageData(text.slice(from, text.indexOf(END, from)));
  const { title, accepted, world, steps, times } = data;
  return {
    title,
    accepted,
    world,
    limits: data.limits,
    steps: steps.length,
    duration: times[times.length - 1]! - times[0]!,
    motion: await Motion.unpack(data),
  };
}

/** What follows the word accepted, by the world that result.json names. */
const WORLDS: Record<string, string> = {
  ideal: " in an ideal cell, without errors",
  "without errors": " without errors",
};

/** As much of result.json as is compared. */
interface ResultText {
  format?: string;
  version?: number;
  scene?: { title?: string };
  summary?: { accepted?: boolean; world?: string; limits?: OtherLimit[] };
  steps?: { time: number }[];
}

function ofResult(text: string, version: number): Other {
  let given: ResultText;
  try {
    given = JSON.parse(text) as ResultText;
  } catch {
    throw new BrokenData("it is neither a page of plydrape nor a result.json");
  }
  if (given.format !== "plydrape-result") {
    throw new BrokenData("it is neither a page of plydrape nor a result.json");
  }
  if (given.version !== version) {
    throw new BrokenData(
      `it has version ${String(given.version)}, and this page reads version ${String(version)}: simulate or plan it again`,
    );
  }
  const limits = given.summary?.limits;
  if (limits === undefined || given.steps === undefined) {
    throw new BrokenData("its limits or its steps are missing");
  }
  const times = given.steps.map(({ time }) => time);
  return {
    title: given.scene?.title ?? "without a title",
    accepted: given.summary?.accepted ?? false,
    world: WORLDS[given.summary?.world ?? ""] ?? "",
    // names are those of files: gripper_load
    limits: limits.map((limit) => ({
      ...limit,
      name: limit.name.replaceAll("_", " "),
    })),
    steps: times.length,
    duration: (times[times.length - 1] ?? 0) - (times[0] ?? 0),
    motion: null,
  };
}
