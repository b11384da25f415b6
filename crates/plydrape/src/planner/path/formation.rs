//! Positions of the grippers while a front passes over the mold: the net on the mold that is lifted ahead of the front.
//!
//! Inside the front the net is the ideal drape, outside it the fabric curves away from the mold. Because it is a net
//! at every moment, fiber lengths are right at every moment. Then its lines are made taut, see `taut`. A pretension
//! stretches what is ahead of the front a little.

use super::strategy::Strategy;
use super::tabulation::{around, height_grid};
use super::taut::Lines;
use super::tuning::TUNING;
use crate::geometry::Point;
use crate::geometry::vector::{along, dot, sub};
use crate::mold::{FrontSurface, Graph, HeightGrid, Mold, Pose, Rise, Surface};
use crate::net::{Net, Placement};
use crate::ply::Ply;
use crate::scene::Scene;
use std::sync::Arc;

/// What formations of a scene share: heights of its mold, which are lifted ahead of a front, and the lines of its ply.
#[derive(Debug, Clone)]
pub struct MoldHeights {
    heights: Arc<HeightGrid>,
    lines: Option<Arc<Lines>>,
}

/// The formation of grippers behind and ahead of one front.
#[derive(Debug, Clone)]
pub struct Formation<'a> {
    heights: Arc<HeightGrid>,
    /// The lines between grippers; `None` where the ideal drape is not known as a net.
    lines: Option<Arc<Lines>>,
    /// The net from the front's start; `None` where the ideal drape is not known as a net.
    layup: Option<Placement>,
    ply: &'a Ply,
    targets: &'a [Point],
    strategy: Strategy,
    center: [f64; 2],
    /// Unit of length (m).
    cell: f64,
    /// From each gripper's place in the net on the mold to its target (m).
    offsets: Vec<Point>,
}

impl MoldHeights {
    /// The heights of a scene's mold around its drape; `None` without a mold or a target.
    #[must_use]
    pub fn new(scene: &Scene) -> Option<Self> {
        let heights = heights(scene.layup.mold.as_ref()?, &scene.layup.target.as_ref()?.grippers)?;
        Some(MoldHeights { heights: Arc::new(heights), lines: Lines::new(scene).map(Arc::new) })
    }

    /// Heights for formations whose lines stay as long as the net on the lifted mold makes them: equation (17) of
    /// `docs/theory` alone. They hang slack ahead of the front, and are there to be compared with.
    #[must_use]
    pub fn untightened(self) -> Self {
        MoldHeights { lines: None, ..self }
    }
}

impl<'a> Formation<'a> {
    /// The formation of a strategy; `None` without a mold or a target.
    #[must_use]
    pub fn new(scene: &'a Scene, heights: &MoldHeights, strategy: Strategy) -> Option<Self> {
        let target = scene.layup.target.as_ref()?;
        let layup = layup(scene, &strategy);
        let count = target.grippers.len() as f64;
        let middle = [0, 1].map(|n| target.grippers.iter().map(|p| p[n]).sum::<f64>() / count);
        let mut formation = Formation {
            heights: Arc::clone(&heights.heights),
            lines: heights.lines.clone(),
            layup,
            ply: &scene.layup.ply,
            targets: &target.grippers,
            strategy,
            center: layup.map_or(middle, |layup| [layup.place[0], layup.place[1]]),
            cell: scene.layup.ply.shorter_side(),
            offsets: Vec::new(),
        };
        let beyond = 2.0 * formation.reach() + 1.0;
        let still = vec![[0.0; 3]; target.grippers.len()];
        formation.offsets = match formation.net(beyond) {
            Some(ends) => target.grippers.iter().zip(ends).map(|(a, b)| sub(*a, b)).collect(),
            None => still,
        };
        Some(formation)
    }

    fn lift(&self, front: f64) -> Rise {
        let Strategy { ratio, angle, squareness, curvature, slope, .. } = self.strategy;
        let (curvature, tip) = (curvature / self.cell, TUNING.front.tip * self.cell);
        let center = self.center;
        Rise { center, angle, ratio, squareness, front, curvature, slope, tip }
    }

    /// How far the front has to come to have passed every gripper (m).
    #[must_use]
    pub fn reach(&self) -> f64 {
        let lift = self.lift(0.0);
        self.targets.iter().map(|p| lift.radius([p[0], p[1]])).fold(0.0, f64::max)
    }

    /// The net on the lifted mold at the grippers (m); `None` where it folds or there is none.
    fn net(&self, front: f64) -> Option<Vec<Point>> {
        let layup = self.layup?;
        let lifted = FrontSurface { mold: Arc::clone(&self.heights), rise: self.lift(front) };
        let (pose, surface) = (Pose::new([0.0; 3], [0.0; 3]), Surface::Front(lifted));
        let mold = Mold::Graph(Graph { pose, surface, domain: None });
        let place = mold.highest_point(self.center)?;
        let net = Net::drape(&mold, Placement { place, ..layup }).ok()?;
        let place = |n: usize| net.place_or_node(&mold, self.ply.place(n));
        (0..self.ply.grippers()).map(place).collect()
    }

    /// Gripper positions (m) when the front has come to `front` (m).
    #[must_use]
    pub fn grippers(&self, front: f64) -> Vec<Point> {
        let Some(net) = self.net(front) else {
            // without a net, straight above their targets
            let lift = FrontSurface { mold: Arc::clone(&self.heights), rise: self.lift(front) };
            let raise = |p: &Point| [p[0], p[1], p[2] + lift.rise_at(p[0], p[1])];
            return self.targets.iter().map(raise).collect();
        };
        let mut grippers: Vec<Point> =
            net.into_iter().zip(&self.offsets).map(|(p, offset)| along(p, 1.0, *offset)).collect();
        let Some(lines) = &self.lines else { return grippers };
        let rise = self.lift(front);
        let radius = |p: Point| rise.radius([p[0], p[1]]);
        let landed: Vec<bool> = self.targets.iter().map(|p| radius(*p) <= front).collect();
        for (n, gripper) in grippers.iter_mut().enumerate().filter(|(n, _)| landed[*n]) {
            *gripper = self.targets[n];
        }
        lines.tighten(&mut grippers, &landed, radius, front, self.strategy.pretension);
        grippers
    }
}

/// The layup of a scene's ideal drape, begun where the front starts; `None` where the drape is not known.
fn layup(scene: &Scene, strategy: &Strategy) -> Option<Placement> {
    let (mold, drape) = (scene.layup.mold.as_ref()?, scene.layup.target.as_ref()?.drape.as_ref()?);
    let [origin, high] = scene.layup.ply.held_bounds();
    let divisions = TUNING.front.divisions as f64;
    let size = [0, 1].map(|n| high[n] - origin[n]);
    // a whole number of meshes, of which at least this many make a cell
    let cells = [0, 1].map(|n| size[n] / scene.layup.ply.cell[n]);
    let parts = cells.map(|cells| (cells * divisions * (1.0 - 1e-9)).ceil().max(0.0));
    let mesh = [0, 1].map(|n| match parts[n] {
        0.0 => scene.layup.ply.cell[n] / divisions,
        parts => size[n] / parts,
    });
    let nodes = parts.map(|parts| parts as usize + 1);
    let seed = [0, 1].map(|n| (strategy.start[n] * parts[n]).round() as usize);
    let uv = [0, 1].map(|n| origin[n] + seed[n] as f64 * mesh[n]);
    let place = drape.place(mold, uv)?;
    let [u, v] = drape.fibers(mold, uv)?;
    let shear = dot(u, v).clamp(-1.0, 1.0).asin();
    Some(Placement {
        nodes,
        mesh,
        origin,
        seed,
        place,
        heading: u[1].atan2(u[0]),
        shear,
        ..drape.placement
    })
}

/// Heights of a mold over the drape and some margin around it.
fn heights(mold: &Mold, targets: &[Point]) -> Option<HeightGrid> {
    let front = TUNING.front;
    let top = targets.iter().map(|p| p[2]).fold(f64::NEG_INFINITY, f64::max);
    height_grid(around(targets, front.height_margin), front.height_nodes, |place| {
        height(mold, place, top)
    })
}

/// Height of a mold at (x, y) (m); beyond its boundary that of the tangent plane there.
fn height(mold: &Mold, [x, y]: [f64; 2], top: f64) -> f64 {
    if let Some(place) = mold.highest_point([x, y]) {
        return place[2];
    }
    let mut z = top;
    for _ in 0..TUNING.front.border_rounds {
        let closest = mold.closest_point([x, y, z]);
        let [nx, ny, nz] = closest.normal;
        let fall = nx * (x - closest.point[0]) + ny * (y - closest.point[1]);
        // an upright border would lead nowhere
        z = closest.point[2] - fall / nz.abs().max(TUNING.front.upright_border);
    }
    z
}
