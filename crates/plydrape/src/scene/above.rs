//! A ply and a mold as a scene: the ideal drape is the target, and the grippers start level above it.

use super::Scene;
use crate::geometry::Point;
use crate::layup::{Settings, Target};
use crate::mold::Mold;
use crate::motion::Motion;
use crate::net::{EdgeRule, Generators, Layup as NetLayup, LayupError, Net};
use crate::ply::Ply;
use std::sync::Arc;

/// Meshes of the ideal drape along each side of a cell: an even number, so that the middle of every ply is a node.
const MESHES: usize = 4;
/// Distance of neighbors at the start as a share of the fabric between them: that of Krogh et al. 2018.
const CLOSER: f64 = 0.98;
/// Height of the start above the highest point of the drape, in cells.
const CLEAR: f64 = 0.5;

/// Why a ply and a mold make no scene.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AboveError {
    /// The mold has no point at the place of the ply.
    #[error("the mold has no point at x = {} m, y = {} m", place[0], place[1])]
    NoPoint {
        /// Where the middle of the ply should lie (m).
        place: [f64; 2],
    },
    /// The ideal drape cannot begin there.
    #[error(transparent)]
    Layup(#[from] LayupError),
    /// The ideal drape has no place on the mold for some grippers.
    #[error("{missing} grippers have no place on the mold: the ply reaches beyond it, or folds")]
    Missing {
        /// How many.
        missing: usize,
    },
}

impl Scene {
    /// A ply that is to lie on a mold, the middle of its grippers at the place x, y (m) and u along x as seen from above, with the usual
    /// rules and limits. The target is the ideal drape with geodesic generators; the grippers start level above it, 2 % closer than the
    /// fabric between them and half a cell above its highest point. There is no motion but the start: [`crate::plan`] finds one.
    ///
    /// # Errors
    /// [`AboveError`] if the ply has no ideal drape there.
    pub fn above(ply: Ply, mold: Mold, place: [f64; 2]) -> Result<Self, AboveError> {
        let seed = mold.highest_point(place).ok_or(AboveError::NoPoint { place })?;
        let [low, high] = ply.held_bounds();
        let mesh = ply.cell.map(|side| side / MESHES as f64);
        // an array of one row has meshes across as long as those along
        let mesh = [mesh[0], if mesh[1] > 0.0 { mesh[1] } else { mesh[0] }];
        let count = [0, 1].map(|n| (0.5 * (high[n] - low[n]) / mesh[n]).round() as usize);
        let net = NetLayup {
            nodes: count.map(|half| 2 * half + 1),
            mesh,
            origin: low,
            seed: count,
            place: seed,
            heading: 0.0,
            shear: 0.0,
            generators: Generators::Geodesic,
            edges: EdgeRule::default(),
        };
        let net = Net::drape(&mold, net)?;
        let grippers = 0..ply.grippers();
        let ends: Vec<Point> =
            grippers.filter_map(|n| net.place_or_node(&mold, ply.place(n))).collect();
        if ends.len() < ply.grippers() {
            return Err(AboveError::Missing { missing: ply.grippers() - ends.len() });
        }
        let start = start_above(&ply, &net);
        let motion = Motion { times: vec![0.0], positions: vec![start] };
        let mut scene = Scene::new(ply, Settings::default(), motion);
        scene.layup.mold = Some(mold);
        scene.layup.target = Some(Target { grippers: ends, drape: Some(Arc::new(net)) });
        // limits that are of the mold
        scene.limits = crate::measure::Limits::of(&scene.layup);
        Ok(scene)
    }
}

/// Positions of the grippers (m) level above the middle of an ideal drape, u along its heading.
fn start_above(ply: &Ply, net: &Net) -> Vec<Point> {
    let nodes: Vec<Point> = net.nodes.iter().flatten().copied().collect();
    let count = nodes.len().max(1) as f64;
    let middle = [0, 1].map(|n| nodes.iter().map(|node| node[n]).sum::<f64>() / count);
    let top = nodes.iter().map(|node| node[2]).fold(f64::NEG_INFINITY, f64::max);
    let side = if ply.cell[1] > 0.0 { ply.cell[0].min(ply.cell[1]) } else { ply.cell[0] };
    let [low, high] = ply.held_bounds();
    let (sin, cos) = net.layup.heading.sin_cos();
    let position = |n: usize| {
        let place = ply.place(n);
        let [u, v] = [0, 1].map(|c| CLOSER * (place[c] - 0.5 * (low[c] + high[c])));
        [middle[0] + cos * u - sin * v, middle[1] + sin * u + cos * v, top + CLEAR * side]
    };
    (0..ply.grippers()).map(position).collect()
}
