//! Where on the fabric the generators start, and how the ply is turned: the choice of least shear.
//!
//! A net follows from its seed, so nets from different seeds differ although the ply is asked to lie in the same place. Each
//! seed is therefore brought to where the *held* fabric point comes to its place with its heading: the net is draped, the
//! frame of place, u and normal that the held point has is moved to the frame that it should have, and the seed with it. On
//! planes and spheres one such correction is exact, elsewhere a few are enough. Nothing depends on the number of threads.

use super::boundary::PlyPoint;
use super::surface_point::{ExtendedSurface, SurfacePoint};
use super::tuning::TUNING;
use super::{Coverage, Net, Placement};
use crate::Error;
use crate::geometry::vector::{along, cross, distance, dot, norm, sub, unit};
use crate::mold::Mold;
use crate::ply::Outline;
use rayon::prelude::*;
use std::f64::consts::TAU;

/// What a search may choose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Free {
    /// The seed: where on the fabric the generators start.
    pub seed: bool,
    /// The heading of u.
    pub heading: bool,
}

/// A seed and a heading, and what they cost.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Choice {
    /// The seed: a node of the net.
    pub seed: [usize; 2],
    /// Fabric point, and where it lies (m).
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub at: PlyPoint,
    /// Heading of u at the seed, seen in plan (rad).
    pub heading: f64,
    /// The heading of u that is asked of the held point (rad).
    pub held_heading: f64,
    /// Largest shear on the ply with the net that all choices are compared with (rad); `None` if it has no whole cell.
    pub largest_shear: Option<f64>,
    /// Largest shear with the net of the scene (rad), of the few choices that were compared with that.
    pub largest_shear_fine: Option<f64>,
    /// Nodes of the ply without a place, with the net that the choice was compared with last.
    pub missing: usize,
    /// Distance of the held point from where it should lie (m), and turn of u there (rad); `None` if it has no place.
    pub off: Option<(f64, f64)>,
}

/// What each choice of a seed and of a heading costs, and which one is taken.
#[derive(Debug, Clone, PartialEq)]
pub struct Seeds {
    /// What was tried, in a fixed order.
    pub choices: Vec<Choice>,
    /// The one that is taken.
    pub chosen: usize,
    /// The net of the scene with it.
    pub placement: Placement,
    /// Mesh widths of the net that all choices were compared with (m).
    pub mesh: [f64; 2],
}

impl Seeds {
    /// Searches for the seed and the heading with the least largest shear on the ply.
    ///
    /// `placement` says where the held fabric point, its seed, is to lie, with which heading; `outline` is that of a ply that is
    /// cut. Where no choice keeps the held point in place, the placement itself is taken.
    ///
    /// # Errors
    /// The errors of [`Net::drape`] if no net can be begun at the held point.
    pub fn search(
        mold: &Mold,
        placement: Placement,
        outline: Option<&Outline>,
        free: Free,
    ) -> Result<Self, Error> {
        placement.check(mold)?;
        let outline = outline.cloned().or_else(|| placement.outline());
        // the heading first, then the seed for that heading, on a coarse net
        let coarse = Search::new(mold, placement, outline.as_ref(), coarse_step(&placement));
        let mut choices: Vec<Choice> = Vec::new();

        let mut heading = placement.heading;
        if free.heading {
            heading = coarse.best_heading(&mut choices);
        }
        let start = coarse.choice(coarse.held.seed, heading);
        if !choices.iter().any(|choice| is_same(choice, &start)) {
            choices.push(start);
        }
        if free.seed {
            coarse.try_seeds(heading, &mut choices);
        }

        // the best few and the held point itself, with the net of the scene
        let fine = Search::new(mold, placement, outline.as_ref(), 1);
        let mut order: Vec<usize> = Vec::new();
        let mut left: Vec<usize> = (0..choices.len()).collect();
        while order.len() < TUNING.finalists
            && let Some(best) = coarse.best(&choices, &left, |choice| choice.largest_shear)
        {
            left.retain(|n| *n != best);
            order.push(best);
        }
        let held = choices.iter().position(|choice| is_same(choice, &start)).unwrap_or(0);
        if !order.contains(&held) {
            order.push(held);
        }
        let measured: Vec<Choice> = order
            .par_iter()
            .map(|n| fine.choice(coarse.fine_node(choices[*n].seed), choices[*n].held_heading))
            .collect();
        for choice in &mut choices {
            choice.seed = coarse.fine_node(choice.seed);
        }
        for (n, fine) in order.iter().zip(measured) {
            let coarse = choices[*n];
            choices[*n] = Choice {
                largest_shear: coarse.largest_shear,
                largest_shear_fine: fine.largest_shear,
                ..fine
            };
        }
        // the least shear on the net of the scene decides; a choice that cannot keep the held point in place leaves the placement as it
        // is
        let chosen =
            fine.best(&choices, &order, |choice| choice.largest_shear_fine).unwrap_or(held);
        let Choice { seed, at, heading, .. } = choices[chosen];
        let taken = if choices[chosen].off.is_some() {
            Placement { seed, place: at.place, heading, ..placement }
        } else {
            placement
        };
        Ok(Seeds { choices, chosen, placement: taken, mesh: coarse.held.mesh })
    }
}

fn is_same(a: &Choice, b: &Choice) -> bool {
    a.seed == b.seed && a.held_heading == b.held_heading
}

/// How many meshes of the scene are one of the net that choices are compared with.
fn coarse_step(placement: &Placement) -> usize {
    let nodes = (placement.nodes[0] * placement.nodes[1]) as f64;
    (nodes / TUNING.search_nodes as f64).sqrt().ceil().max(1.0) as usize
}

/// One net that choices are compared with.
struct Search<'a> {
    mold: &'a Mold,
    /// With the held point as its seed.
    held: Placement,
    coverage: Coverage,
    /// Meshes of the scene's net in one of this net, and the node of that net at this net's first.
    step: usize,
    first: [isize; 2],
    /// Share of the mesh width and angle (rad) at which the held point is in its place.
    in_place: f64,
}

/// A place on the mold with its directions.
#[derive(Debug, Clone, Copy)]
struct Frame {
    place: [f64; 3],
    axes: [[f64; 3]; 3],
}

impl Frame {
    /// From a place, a tangent and the normal there.
    fn new(place: [f64; 3], u: [f64; 3], normal: [f64; 3]) -> Option<Self> {
        let u = unit(along(u, -dot(u, normal), normal))?;
        Some(Frame { place, axes: [u, cross(normal, u), normal] })
    }

    /// A direction turned with this frame into another.
    fn turned(&self, v: [f64; 3], into: &Frame) -> [f64; 3] {
        let parts = self.axes.map(|axis| dot(axis, v));
        [0, 1, 2].map(|n| (0..3).map(|k| parts[k] * into.axes[k][n]).sum())
    }
}

impl<'a> Search<'a> {
    fn new(mold: &'a Mold, placement: Placement, outline: Option<&Outline>, step: usize) -> Self {
        // so many coarse meshes that they cover the net, from the held point outwards
        let before = placement.seed.map(|n| n.div_ceil(step));
        let after = [0, 1].map(|n| (placement.nodes[n] - 1 - placement.seed[n]).div_ceil(step));
        let mesh = placement.mesh.map(|d| d * step as f64);
        let [u, v] = placement.fabric(placement.seed);
        let held = Placement {
            nodes: [0, 1].map(|n| before[n] + after[n] + 1),
            mesh,
            origin: [u - before[0] as f64 * mesh[0], v - before[1] as f64 * mesh[1]],
            seed: before,
            ..placement
        };
        let first = [0, 1].map(|n| placement.seed[n] as isize - (before[n] * step) as isize);
        let in_place = if step > 1 { TUNING.about_in_place } else { TUNING.in_place };
        Search { mold, held, coverage: Coverage::new(&held, outline), step, first, in_place }
    }

    /// A node in the net of the scene.
    fn fine_node(&self, node: [usize; 2]) -> [usize; 2] {
        [0, 1].map(|n| (self.first[n] + (node[n] * self.step) as isize).max(0) as usize)
    }

    /// The net from the held point itself.
    fn reference(&self, held_heading: f64) -> Option<Net> {
        let held = Placement { heading: held_heading, ..self.held };
        Net::drape_covered(self.mold, held, &self.coverage).ok()
    }

    /// What a seed and a heading of the held point cost.
    fn choice(&self, seed: [usize; 2], held_heading: f64) -> Choice {
        self.choice_from(self.reference(held_heading).as_ref(), seed, held_heading)
    }

    /// A choice, from the net of the held point.
    fn choice_from(&self, reference: Option<&Net>, seed: [usize; 2], held_heading: f64) -> Choice {
        let held = Placement { heading: held_heading, ..self.held };
        let at = PlyPoint { fabric: held.fabric(seed), place: held.place };
        let none = Choice {
            seed,
            at,
            heading: held_heading,
            held_heading,
            largest_shear: None,
            largest_shear_fine: None,
            missing: self.held.nodes[0] * self.held.nodes[1],
            off: None,
        };
        let Some((net, off)) = reference.and_then(|net| self.draped(net, seed)) else {
            return none;
        };
        Choice {
            at: PlyPoint { place: net.placement.place, ..at },
            heading: net.placement.heading,
            largest_shear: net.report.largest_shear.map(|(largest, _)| largest),
            missing: net.missing.len(),
            off: Some(off),
            ..none
        }
    }

    /// The net from a seed that puts the held point in its place, and how far it is from there.
    fn draped(&self, reference: &Net, seed: [usize; 2]) -> Option<(Net, (f64, f64))> {
        let held = reference.placement;
        let drape = |placement| Net::drape_covered(self.mold, placement, &self.coverage).ok();
        let surface = ExtendedSurface::new(self.mold);
        if seed == held.seed {
            return Some((reference.clone(), (0.0, 0.0)));
        }
        let normal = surface.under(held.place).normal;
        let [u, _] = held.directions(normal).ok()?;
        let target = Frame::new(held.place, u, normal)?;
        let mesh = held.mesh[0].min(held.mesh[1]);

        // where the seed lies in the net from the held point
        let mut start = reference.frame(&surface, held.fabric(seed))?;
        let mut best: Option<(Net, (f64, f64))> = None;
        for _ in 0..TUNING.corrections {
            let place = surface.under(start.place);
            if place.beyond > 0.0 {
                break;
            }
            let [x, y, _] = start.axes[0];
            let placement = Placement { seed, place: place.point, heading: y.atan2(x), ..held };
            let Some(net) = drape(placement) else { break };
            let Some(found) = net.frame(&surface, held.fabric(held.seed)) else { break };
            let off = distance(found.place, target.place);
            let [u, w] = [found.axes[0], target.axes[0]];
            let turn = norm(cross(u, w)).atan2(dot(u, w));
            // the seed moves with the frame of the held point
            let arm = found.turned(sub(start.place, found.place), &target);
            let moved = surface.under(along(target.place, 1.0, arm));
            let course = found.turned(start.axes[0], &target);
            let better = best.as_ref().is_none_or(|(_, (p, q))| off / mesh + turn < p / mesh + q);
            if better {
                best = Some((net, (off, turn)));
            }
            if off <= self.in_place * mesh && turn <= self.in_place || !better {
                break;
            }
            start = Frame::new(moved.point, course, moved.normal)?;
        }
        best
    }

    /// The heading of the held point with the least shear: all around, then ever closer to the best.
    fn best_heading(&self, choices: &mut Vec<Choice>) -> f64 {
        let count = (TAU / TUNING.heading_step).round() as usize;
        let seed = self.held.seed;
        // from −π + step to π
        let around = |n: usize| {
            let n = n as f64 - (count / 2) as f64 + 1.0;
            n * TUNING.heading_step
        };
        choices.par_extend((0..count).into_par_iter().map(|n| self.choice(seed, around(n))));
        let mut step = TUNING.heading_step;
        let best = |choices: &[Choice]| {
            let all: Vec<usize> = (0..choices.len()).collect();
            self.best(choices, &all, |choice| choice.largest_shear)
                .map_or(self.held.heading, |n| choices[n].held_heading)
        };
        let mut heading = best(choices);
        for _ in 0..TUNING.heading_halvings {
            step *= 0.5;
            let beside = [heading - step, heading + step];
            choices.par_extend(beside.par_iter().map(|heading| self.choice(seed, *heading)));
            heading = best(choices);
        }
        heading
    }

    /// Seeds all over the ply, then around the best of them.
    fn try_seeds(&self, heading: f64, choices: &mut Vec<Choice>) {
        let nodes = self.held.nodes;
        let reference = self.reference(heading);
        let mut tried: Vec<[usize; 2]> = vec![self.held.seed];
        let is_seed = |node: [usize; 2]| {
            let fine = [0, 1].map(|n| self.first[n] + (node[n] * self.step) as isize);
            self.coverage.node(node) && fine.iter().all(|n| *n >= 0)
        };
        let mut try_all = |seeds: Vec<[usize; 2]>, choices: &mut Vec<Choice>| {
            let mut new: Vec<[usize; 2]> = Vec::new();
            for seed in seeds {
                if is_seed(seed) && !tried.contains(&seed) {
                    tried.push(seed);
                    new.push(seed);
                }
            }
            let cost = |seed: &[usize; 2]| self.choice_from(reference.as_ref(), *seed, heading);
            choices.par_extend(new.par_iter().map(cost));
        };
        // in the middles of this many equal parts
        let place = |k: usize, n: usize| {
            let share = (k as f64 + 0.5) / TUNING.seeds as f64;
            (share * (nodes[n] - 1) as f64).round() as usize
        };
        let grid = (0..TUNING.seeds * TUNING.seeds)
            .map(|k| [place(k % TUNING.seeds, 0), place(k / TUNING.seeds, 1)]);
        try_all(grid.collect(), choices);

        let all: Vec<usize> = (0..choices.len()).collect();
        let of_heading: Vec<usize> =
            all.into_iter().filter(|n| choices[*n].held_heading == heading).collect();
        let Some(best) = self.best(choices, &of_heading, |choice| choice.largest_shear) else {
            return;
        };
        // half of a part further to each side of the best
        let [i, j] = choices[best].seed;
        let half =
            [0, 1].map(|n| ((nodes[n] - 1) as f64 / (2 * TUNING.seeds) as f64).round() as isize);
        let around = (0..9).map(|k| [k % 3 - 1, k / 3 - 1]).filter_map(|[a, b]: [isize; 2]| {
            let [i, j] = [i as isize + a * half[0], j as isize + b * half[1]];
            let node = [usize::try_from(i).ok()?, usize::try_from(j).ok()?];
            (node[0] < nodes[0] && node[1] < nodes[1]).then_some(node)
        });
        try_all(around.collect(), choices);
    }

    /// The best of some choices: in place, with the fewest missing nodes, then with the least shear; of those alike the
    /// nearest to the held point, then with the least heading, then the first.
    fn best(
        &self,
        choices: &[Choice],
        among: &[usize],
        shear: impl Fn(&Choice) -> Option<f64>,
    ) -> Option<usize> {
        let mesh = self.held.mesh[0].min(self.held.mesh[1]);
        let in_place = |choice: &Choice| {
            choice.off.is_some_and(|(off, turn)| {
                off <= TUNING.about_in_place * mesh && turn <= TUNING.about_in_place
            })
        };
        let placed: Vec<usize> = among.iter().copied().filter(|n| in_place(&choices[*n])).collect();
        let missing = placed.iter().map(|n| choices[*n].missing).min()?;
        let cost = |n: usize| shear(&choices[n]).unwrap_or(0.0);
        let fewest: Vec<usize> =
            placed.into_iter().filter(|n| choices[*n].missing == missing).collect();
        let least = fewest.iter().map(|n| cost(*n)).fold(f64::INFINITY, f64::min);
        let [u, v] = self.held.fabric(self.held.seed);
        let rank = |n: usize| {
            let [p, q] = choices[n].at.fabric;
            ((p - u).hypot(q - v), choices[n].held_heading.abs())
        };
        fewest.into_iter().filter(|n| cost(*n) <= least + TUNING.alike).min_by(|a, b| {
            let (p, q) = (rank(*a), rank(*b));
            // rounding decides nothing
            let far = (p.0 - q.0).abs() > TUNING.boundary_rounding * mesh;
            let distance = if far { p.0.total_cmp(&q.0) } else { std::cmp::Ordering::Equal };
            let turned = (p.1 - q.1).abs() > TUNING.boundary_rounding;
            let turn = if turned { p.1.total_cmp(&q.1) } else { std::cmp::Ordering::Equal };
            distance.then(turn).then(a.cmp(b))
        })
    }
}

impl Net {
    /// The frame of a fabric point (m): its place on the mold or beside it, and the tangent of u.
    fn frame(&self, surface: &ExtendedSurface, uv: [f64; 2]) -> Option<Frame> {
        let SurfacePoint { point, normal, .. } = self.surface_point(surface, uv)?;
        Frame::new(point, self.tangent_u(uv)?, normal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mold::{Face, Graph, Plane, Pose, Saddle, Sphere, Surface};
    use crate::net::{EdgeRule, Generators};

    const SEED: Free = Free { seed: true, heading: false };

    fn sphere(radius: f64) -> Mold {
        let pose = Pose::new([0.0; 3], [0.0; 3]);
        Mold::Sphere(Sphere { pose, radius, face: Face::Outside })
    }

    /// 41 × 41 nodes of 10 mm, the middle held on top of a mold or beside it.
    fn placement(mold: &Mold, at: [f64; 2], heading: f64) -> Placement {
        Placement {
            nodes: [41; 2],
            mesh: [0.01; 2],
            origin: [0.0; 2],
            seed: [20; 2],
            place: mold.highest_point(at).unwrap(),
            heading,
            shear: 0.0,
            generators: Generators::Geodesic,
            edges: EdgeRule::Along,
        }
    }

    /// The shear in a corner is the total curvature between it and the seed (Hazzidakis), so of a square on a sphere the
    /// largest one is least from the middle.
    #[test]
    fn a_square_on_a_sphere_is_best_laid_from_its_middle() {
        let mold = sphere(0.6);
        let placement = placement(&mold, [0.1, -0.05], 0.4);
        let seeds = Seeds::search(&mold, placement, None, SEED).unwrap();
        assert_eq!(seeds.placement, placement);
        let cost = |choice: &Choice| choice.largest_shear.unwrap();
        let middle = cost(&seeds.choices[seeds.chosen]);
        assert!(seeds.choices.len() > 40);
        assert!(seeds.choices.iter().all(|choice| cost(choice) >= middle - 1e-9));
    }

    /// An L: its two arms are 240 mm long and 160 mm wide, so a seed in the corner between them leaves less curvature to the
    /// farthest of its corners than the middle of the box around it, and the middle of that box still lies where it is asked.
    #[test]
    fn an_ell_is_best_laid_from_between_its_arms_and_lies_where_it_is_asked() {
        let mold = sphere(0.6);
        let placement = placement(&mold, [0.1, -0.05], 0.4);
        let ell = vec![[0.0, 0.0], [0.4, 0.0], [0.4, 0.16], [0.16, 0.16], [0.16, 0.4], [0.0, 0.4]];
        let outline = Outline::new(ell, Vec::new()).unwrap();
        let seeds = Seeds::search(&mold, placement, Some(&outline), SEED).unwrap();
        let drape = |placement| Net::drape_cut(&mold, placement, Some(outline.clone())).unwrap();
        let (best, middle) = (drape(seeds.placement), drape(placement));
        let largest = |net: &Net| net.report.largest_shear.unwrap().0.to_degrees();
        assert!(largest(&best) < 0.9 * largest(&middle), "{} {}", largest(&best), largest(&middle));
        assert!(outline.contains(best.placement.fabric(best.placement.seed)));
        // the middle of the box, and u there
        let at = best.node([20, 20]).unwrap();
        assert!(distance(at, placement.place) < 1e-6 * 0.01, "{}", distance(at, placement.place));
        let u = best.fibers(&mold, [0.2, 0.2]).unwrap()[0];
        assert!((u[1].atan2(u[0]) - 0.4).abs() < 1e-5);
        // what was chosen costs what the map says
        let choice = seeds.choices[seeds.chosen];
        assert_eq!(choice.largest_shear_fine.unwrap().to_degrees(), largest(&best));
    }

    /// The shear on a saddle depends on how the ply is turned. None of 45 headings is better by more than 0.2° than the one that
    /// is found, and what was asked plays no part.
    #[test]
    fn on_a_saddle_the_best_heading_is_found_whatever_was_asked() {
        let saddle = Saddle { radii: [0.8, 0.8] };
        let pose = Pose::new([0.0; 3], [0.0; 3]);
        let mold = Mold::Graph(Graph { pose, surface: Surface::Saddle(saddle), domain: None });
        let free = Free { seed: false, heading: true };
        let found = [0.1, 1.3].map(|heading| {
            let seeds =
                Seeds::search(&mold, placement(&mold, [0.0; 2], heading), None, free).unwrap();
            (seeds.placement.heading, seeds.choices[seeds.chosen].largest_shear_fine.unwrap())
        });
        assert_eq!(found[0], found[1]);
        for degrees in 0..45 {
            let placement = placement(&mold, [0.0; 2], f64::from(2 * degrees).to_radians());
            let (shear, _) = Net::drape(&mold, placement).unwrap().report.largest_shear.unwrap();
            assert!(shear > found[0].1 - 0.2_f64.to_radians(), "{degrees} {shear}");
        }
    }

    /// Everything costs nothing on a plane: the held point and the least heading are taken.
    #[test]
    fn on_a_plane_nothing_is_moved() {
        let mold = Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
        let placement = placement(&mold, [0.1, 0.2], 0.7);
        let all = Free { seed: true, heading: true };
        let seeds = Seeds::search(&mold, placement, None, all).unwrap();
        assert_eq!(seeds.placement.seed, [20, 20]);
        assert!(seeds.placement.heading.abs() < 1e-12, "{}", seeds.placement.heading);
        assert_eq!(Seeds::search(&mold, placement, None, SEED).unwrap().placement, placement);
    }

    /// One thread or two: the same choices to the last bit.
    #[test]
    fn the_number_of_threads_changes_nothing() {
        let mold = sphere(0.5);
        let placement = placement(&mold, [0.05, 0.1], 0.2);
        let ell = vec![[0.0, 0.0], [0.4, 0.0], [0.4, 0.1], [0.1, 0.2], [0.0, 0.4]];
        let outline = Outline::new(ell, Vec::new()).unwrap();
        let all = Free { seed: true, heading: true };
        let searched = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Seeds::search(&mold, placement, Some(&outline), all).unwrap())
        };
        assert_eq!(searched(1), searched(2));
    }
}
