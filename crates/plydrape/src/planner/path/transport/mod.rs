//! From the pick-up to the first formation of a front: the array is lifted, carried and lowered as a rigid body, then it
//! is formed near the mold and comes down.
//!
//! 1. `turn`: the rotation that fits the start best to the formation, and all rotations in between;
//! 2. `clearance`: how far the carried array stays above the mold and the table;
//! 3. `carriage`: the steps in which it is lifted, carried and lowered, no higher than this needs;
//! 4. `forming`: the steps in which it changes its shape.
//!
//! While an array is carried, the shape of the ply does not change, so these steps may be long. A start above the first
//! formation with the same heading is not carried: it goes straight down while it is formed.

mod carriage;
mod clearance;
mod forming;
mod turn;

use super::tuning::TUNING;
use crate::geometry::Point;
use crate::geometry::vector::between;
use crate::mold::Mold;
use crate::scene::Scene;
use carriage::Carriage;
use clearance::Clearance;
pub use clearance::bilinear;
use forming::formed;
use turn::center;

/// Positions (m) from the scene's start to a formation of the grippers, of a plan with this many steps; the formation itself
/// is the next step. `None` without a mold or a start.
#[must_use]
pub fn transport(scene: &Scene, formation: &[Point], steps: usize) -> Option<Vec<Vec<Point>>> {
    let start = scene.layup.start();
    let mold = scene.layup.mold.as_ref()?;
    let height = TUNING.transport.formed_height * scene.layup.ply.shorter_side();
    let above: Vec<Point> = formation.iter().map(|p| [p[0], p[1], p[2] + height]).collect();
    let mut positions = Carriage::new(scene, mold, start, &above).positions(start, steps);
    let carried = positions[positions.len() - 1].clone();
    let share = |share: f64| ((share * steps as f64).round() as usize).max(1);
    let forming = share(TUNING.transport.forming);
    let tight = TUNING.transport.tight;
    let edges: Vec<[usize; 2]> =
        scene.layup.ply.neighbors().iter().map(|pair| pair.grippers).collect();
    let form = |k: usize| formed(&edges, &carried, &above, k as f64 / forming as f64, tight);
    positions.extend((1..forming).map(form));
    let descent = share(TUNING.transport.descent);
    let down = |k: usize| {
        let pairs = above.iter().zip(formation);
        pairs.map(|(a, b)| between(*a, *b, k as f64 / descent as f64)).collect()
    };
    positions.extend((0..descent).map(down));
    Some(positions)
}

/// Whether the ply surely hangs clear of the mold at the start of a scene, so that nobody need hang it.
pub fn is_surely_clear(scene: &Scene, mold: &Mold) -> bool {
    let start = scene.layup.start();
    Clearance::new(scene, mold, start, center(start)).starts_clear()
}
