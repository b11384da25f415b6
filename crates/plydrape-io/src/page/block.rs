//! Many integers in little text: what the page is drawn from.
//!
//! Numbers of one step after the other become differences, first from the item before, then from the step before;
//! these are small and alike. Signs go to the lowest bit, the four bytes of all numbers into four planes, and
//! what is left is deflated and written in 64 letters. The page undoes it in the opposite order. The live page is given the
//! integers as they are: they are not in its file, and it needs them at once.

use base64::{Engine, engine::general_purpose::STANDARD};
use miniz_oxide::deflate::compress_to_vec_zlib;
use serde::Serialize;

/// How hard to compress, of 10; more takes longer and gains little.
const LEVEL: u8 = 7;

/// Integers of all steps: this many items a step, each of this many components.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(super) struct Block {
    steps: usize,
    count: usize,
    components: usize,
    data: Data,
}

/// The integers of a block.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(untagged)]
enum Data {
    Packed(String),
    Plain(Vec<i32>),
}

impl Block {
    /// Integers as they are, those of a step side by side, those of an item side by side in them.
    pub fn plain(steps: usize, components: usize, values: Vec<i32>) -> Self {
        let count = values.len() / steps.max(1) / components.max(1);
        Block { steps, count, components, data: Data::Plain(values) }
    }

    /// A block of integers, packed.
    pub fn new(steps: usize, components: usize, values: &[i32]) -> Self {
        let row = values.len() / steps.max(1);
        let before = |n: usize| match n {
            _ if n >= row => values[n - row],
            _ if n >= components => values[n - components],
            _ => 0,
        };
        let folded = values.iter().enumerate().map(|(n, value)| {
            let change = value.wrapping_sub(before(n));
            ((change << 1) ^ (change >> 31)) as u32
        });
        let folded: Vec<u32> = folded.collect();
        let planes = (0..4).flat_map(|byte| folded.iter().map(move |v| (v >> (8 * byte)) as u8));
        let bytes: Vec<u8> = planes.collect();
        let data = Data::Packed(STANDARD.encode(compress_to_vec_zlib(&bytes, LEVEL)));
        Block { steps, count: row / components.max(1), components, data }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use miniz_oxide::inflate::decompress_to_vec_zlib;

    /// The way back, as the page goes it.
    fn unpacked(block: &Block) -> Vec<i32> {
        let Data::Packed(text) = &block.data else { panic!("not packed") };
        let bytes = decompress_to_vec_zlib(&STANDARD.decode(text).unwrap()).unwrap();
        let row = block.count * block.components;
        let size = block.steps * row;
        assert_eq!(bytes.len(), 4 * size);
        let mut out = vec![0_i32; size];
        for n in 0..size {
            let folded: u32 = (0..4).map(|b| u32::from(bytes[b * size + n]) << (8 * b)).sum();
            let change = (folded >> 1) as i32 ^ -((folded & 1) as i32);
            let before = match n {
                _ if n >= row => out[n - row],
                _ if n >= block.components => out[n - block.components],
                _ => 0,
            };
            out[n] = before.wrapping_add(change);
        }
        out
    }

    /// Every integer comes back, those at both ends of the range too.
    #[test]
    fn a_block_unpacks_to_what_was_packed() {
        let values: Vec<i32> = (0..120)
            .map(|n: i32| n.pow(2) * if n % 3 == 0 { -1 } else { 1 })
            .chain([i32::MAX, i32::MIN, 0, i32::MIN, i32::MAX, -1])
            .collect();
        for (steps, components) in [(1, 1), (1, 3), (3, 3), (2, 1), (7, 2)] {
            let block = Block::new(steps, components, &values);
            assert_eq!(unpacked(&block), values, "{steps} {components}");
        }
        assert!(unpacked(&Block::new(3, 3, &[])).is_empty());
    }

    /// A smooth motion takes less than two letters a number.
    #[test]
    fn smooth_motions_are_small() {
        let place = |s: usize, n: usize| 1e5 * (0.02 * s as f64 + 0.01 * n as f64).sin();
        let values: Vec<i32> =
            (0..50).flat_map(|s| (0..2000).map(move |n| place(s, n) as i32)).collect();
        let size = serde_json::to_string(&Block::new(50, 1, &values)).unwrap().len();
        assert!(size < 2 * values.len(), "{size}");
    }
}
