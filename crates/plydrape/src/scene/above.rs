//! A ply and a mold as a scene: the ideal drape is the target, and the grippers start level above it.

use super::Scene;
use crate::Error;
use crate::geometry::Point;
use crate::layup::{Settings, Target};
use crate::mold::Mold;
use crate::motion::Motion;
use crate::net::{EdgeRule, Generators, Net, Placement};
use crate::ply::{Grid, Ply};
use std::sync::Arc;

/// Widest mesh of the ideal drape on a curved mold, as a share of the shorter side of a cell.
const MESH: f64 = 0.1;
/// Distance of neighbors at the start as a share of the fabric between them: that of Krogh et al. 2018.
const CLOSER: f64 = 0.98;
/// Height of the start above the highest point of the drape, in cells.
const CLEAR: f64 = 0.5;

impl Scene {
    /// A ply that is to lie on a mold, the middle of its grippers at the place x, y (m) and u along x as seen from above, with the usual
    /// rules and limits. The target is the ideal drape with geodesic generators; the grippers start level above it, 2 % closer than the
    /// fabric between them and half a cell above its highest point. There is no motion but the start: [`crate::plan`] finds one.
    ///
    /// # Errors
    /// [`Error::MoldNoPoint`] if the mold has no point there, [`Error::Layup`] or [`Error::GrippersOffMold`] if the ply has no ideal drape there.
    pub fn above(ply: Ply, mold: Mold, place: [f64; 2]) -> Result<Self, Error> {
        let seed = mold.highest_point(place).ok_or(Error::MoldNoPoint { place })?;
        let [low, high] = ply.held_bounds();
        let meshes = meshes(&ply, &mold);
        let mesh = [0, 1].map(|n| ply.cell[n] / meshes[n] as f64);
        // a strip has no cells across, and meshes there as long as those along
        let mesh = [mesh[0], if mesh[1] > 0.0 { mesh[1] } else { mesh[0] }];
        let count = [0, 1].map(|n| (0.5 * (high[n] - low[n]) / mesh[n]).round() as usize);
        let net = Placement {
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
            return Err(Error::GrippersOffMold { missing: ply.grippers() - ends.len() });
        }
        let start = start_above(&ply, &net);
        let motion = Motion { times: vec![0.0], positions: vec![start] };
        let mut scene = Scene::new(ply, Settings::default(), motion);
        scene.layup.mold = Some(mold);
        scene.layup.target = Some(Target { grippers: ends, drape: Some(Arc::new(net)) });
        // limits that are of the mold
        scene.limits = crate::measure::Limits::usual(&scene.layup);
        Ok(scene)
    }
}

/// The fewest meshes of an ideal drape along each side of a cell that are no wider than [`MESH`] and put a node in the middle of the
/// ply; a plane needs none.
fn meshes(ply: &Ply, mold: &Mold) -> [usize; 2] {
    let widest = match mold {
        Mold::Plane(_) => f64::INFINITY,
        _ => MESH * ply.shorter_side(),
    };
    let [low, high] = ply.held_bounds();
    [0, 1].map(|n| {
        // a quotient of decimal lengths that is all but whole is whole
        let least = (ply.cell[n] / widest * (1.0 - 1e-9)).ceil().max(1.0) as usize;
        let odd = ((high[n] - low[n]) / ply.cell[n]).round() as usize % 2 == 1;
        if odd { least.next_multiple_of(2) } else { least }
    })
}

/// Positions of the grippers (m) at the start unless a scene says others: level above the middle of an ideal drape with u along its
/// heading, 2 % closer to each other than the fabric between them, and half a cell above its highest point.
#[must_use]
pub fn start_above(ply: &Ply, net: &Net) -> Vec<Point> {
    let middle = |points: &[Point]| -> [f64; 2] {
        let count = points.len().max(1) as f64;
        [0, 1].map(|n| points.iter().map(|point| point[n]).sum::<f64>() / count)
    };
    let nodes: Vec<Point> = net.nodes.iter().flatten().copied().collect();
    let top = nodes.iter().map(|node| node[2]).fold(f64::NEG_INFINITY, f64::max);
    let (sin, cos) = net.placement.heading.sin_cos();
    let placed = |[x, y]: [f64; 2]| -> Vec<Point> {
        let position = |n: usize| {
            let [u, v] = match ply.grid {
                Grid::NONE => ply.place(n).map(|c| CLOSER * c),
                grid => {
                    let [i, j] = grid.id(n).map(|c| c as f64);
                    [i * (CLOSER * ply.cell[0]), j * (CLOSER * ply.cell[1])]
                }
            };
            let z = top + CLEAR * ply.shorter_side();
            [x + u * cos + v * -sin, y + u * sin + v * cos, z]
        };
        (0..ply.grippers()).map(position).collect()
    };
    let (here, there) = (middle(&placed([0.0; 2])), middle(&nodes));
    placed([there[0] - here[0], there[1] - here[1]])
}
