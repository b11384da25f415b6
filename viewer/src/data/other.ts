/** A second result, from a file that the reader chooses: its page, which can be drawn, or its result.json, whose limits can be compared. */

import { Motion } from "./motion";
import { BrokenData, readPageData, type Limit } from "./page_data";

/** A limit and how it was kept, as pages and results hold it. */
export type OtherLimit = Pick<Limit, "name" | "value" | "limit" | "unit" | "ok">;

export interface Other {
  title: string;
  accepted: boolean;
  /** The limits of its sheet, if it has one, and all others. */
  sheet: OtherLimit[] | null;
  own: OtherLimit[];
  /** Steps and time of the motion (s). */
  steps: number;
  duration: number;
  /** What can be drawn; null of a result.json. */
  motion: Motion | null;
}

/** What stands around the data in a page. */
const START = /<script type="application\/json" id="plydrape-data">/;
const END = "</script>";

/** Reads a page or a result from its text; the message of what it throws is a sentence for the reader. */
export async function readOther(text: string): Promise<Other> {
  const start = START.exec(text);
  if (start === null) return ofResult(text);
  const from = start.index + start[0].length;
  const data = readPageData(text.slice(from, text.indexOf(END, from)));
  const { title, accepted, steps, times } = data;
  return {
    title,
    accepted,
    sheet: data.sheet?.limits ?? null,
    own: data.limits,
    steps: steps.length,
    duration: times[times.length - 1]! - times[0]!,
    motion: await Motion.unpack(data),
  };
}

/** As much of result.json as is compared. */
interface ResultText {
  format?: string;
  scene?: { title?: string };
  summary?: { accepted?: boolean; limits?: OtherLimit[]; sheet?: { limits?: OtherLimit[] } | null };
  steps?: { time: number }[];
}

function ofResult(text: string): Other {
  let given: ResultText;
  try {
    given = JSON.parse(text) as ResultText;
  } catch {
    throw new BrokenData("it is neither a page of plydrape nor a result.json");
  }
  const limits = given.summary?.limits;
  if (given.format !== "plydrape-result" || limits === undefined || given.steps === undefined) {
    throw new BrokenData("it is neither a page of plydrape nor a result.json");
  }
  // names are those of files: gripper_load
  const named = (list: OtherLimit[]) =>
    list.map((limit) => ({ ...limit, name: limit.name.replaceAll("_", " ").replace("fibre", "fiber") }));
  const times = given.steps.map(({ time }) => time);
  const sheet = given.summary?.sheet?.limits;
  return {
    title: given.scene?.title ?? "without a title",
    accepted: given.summary?.accepted ?? false,
    sheet: sheet === undefined ? null : named(sheet),
    own: named(limits),
    steps: times.length,
    duration: (times[times.length - 1] ?? 0) - (times[0] ?? 0),
    motion: null,
  };
}
