/**
 * Integers over the steps, packed to keep the page small.
 *
 * base64 → zlib → unsigned 32-bit numbers as four byte planes (lowest bytes first) → zigzag → differences:
 * in the first step to the item before, later to the same item one step before. Undone here in reverse.
 */

import { BrokenData, type Block } from "./page_data";

/** Integers [steps][count][components], step after step. */
export class Frames {
  constructor(
    readonly steps: number,
    readonly count: number,
    readonly components: number,
    readonly values: Int32Array,
  ) {}

  /** The numbers of one step (a view, no copy). */
  at(index: number): Int32Array {
    const size = this.count * this.components;
    return this.values.subarray(index * size, (index + 1) * size);
  }
}

/** Unpacks a block; `name` says in a message which one is broken. */
export async function unpack(block: Block, name: string): Promise<Frames> {
  const { steps, count, components } = block;
  const total = steps * count * components;
  if (total === 0) return new Frames(steps, count, components, new Int32Array(0));
  if (typeof block.data !== "string")
    return new Frames(steps, count, components, Int32Array.from(block.data));
  let bytes: Uint8Array;
  try {
    bytes = await inflate(fromBase64(block.data));
  } catch {
    throw new BrokenData(`the ${name} of its geometry cannot be unpacked`);
  }
  if (bytes.length !== 4 * total) {
    throw new BrokenData(
      `the ${name} of its geometry has ${bytes.length} bytes and should have ${4 * total}`,
    );
  }
  return new Frames(steps, count, components, integrate(bytes, total, count * components, components));
}

export function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; k++) bytes[k] = binary.charCodeAt(k);
  return bytes;
}

export async function inflate(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Byte planes to differences, and these summed up in place. */
function integrate(bytes: Uint8Array, total: number, size: number, components: number): Int32Array {
  const values = new Int32Array(total);
  for (let k = 0; k < total; k++) {
    const u =
      bytes[k]! | (bytes[k + total]! << 8) | (bytes[k + 2 * total]! << 16) | (bytes[k + 3 * total]! << 24);
    const difference = (u >>> 1) ^ -(u & 1);
    const before = k >= size ? size : components;
    values[k] = difference + (k >= before ? values[k - before]! : 0);
  }
  return values;
}
