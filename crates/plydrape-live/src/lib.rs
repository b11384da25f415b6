//! The solver of the live page: a scene as text goes in, the ply that hangs there comes out as data of a page.
//!
//! The page `live.html` (sources in `viewer/`) writes a scene whenever its reader moves a gripper, bends the mold or changes
//! the material, and draws the answer. The scene is one that `plydrape simulate` reads too, a ply that is held, and it is
//! read, checked, solved, measured and judged by the same code. So this crate computes nothing of its own. It leaves
//! out the step before: each answer depends on its scene alone, not on how a gripper came there, so a link or a
//! saved scene gives the same numbers again.
//!
//! Compiled to `wasm32-unknown-unknown` its functions are those of `boundary`; on other machines it is a library, and its
//! tests run there.

mod answer;
mod boundary;

pub use answer::{Answer, Mold, answer};
