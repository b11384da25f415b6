//! The recorded ply of each step of the transport, and whether it meets the mold where it is moved.
//!
//! A point of the ply goes straight from step to step in this. The distance from the mold changes by no more than a point is moved, so a
//! point whose way in the plan stays farther from the mold than it is moved needs no look at all. Of the others, the moved way is halved until
//! the distances at the ends say that nothing between touches, or that something does.

use super::tuning::TUNING;
use crate::Error;
use crate::bodies::Obstacle;
use crate::draping::free_curves;
use crate::geometry::vector::{between, distance, norm};
use crate::measure::Name;
use crate::mold::Mold;
use crate::outcome::Step;
use crate::pick_up::Moved;
use crate::scene::Scene;
use crate::state::Site;
use rayon::prelude::*;

type Point = [f64; 3];

/// The recorded states of a sheet on its way to the mold.
#[derive(Debug, Clone, Default)]
pub struct SheetShapes {
    /// Fabric coordinates of each node (m).
    pub places: Vec<[f64; 2]>,
    /// Steps, from 0 and ascending, and the positions of all nodes in each (m).
    pub states: Vec<(usize, Vec<Point>)>,
}

/// The ply as points, step by step.
#[derive(Debug)]
pub struct Shapes {
    series: Vec<Series>,
    /// Distance that counts as touching (m).
    tolerance: f64,
}

/// Points that are the same in all steps.
#[derive(Debug)]
struct Series {
    /// What each of them is.
    sites: Sites,
    /// Steps, from 0, and where the points are (m).
    states: Vec<(usize, Vec<Point>)>,
    /// Between each two of them a lower bound of the distance from the mold (m) on the way of each point.
    least: Vec<Vec<f64>>,
}

#[derive(Debug)]
enum Sites {
    /// Fabric coordinates (m).
    Fabric(Vec<[f64; 2]>),
    /// Catenaries by their number.
    Catenaries(Vec<usize>),
}

impl Sites {
    fn label(&self, n: usize, scene: &Scene) -> String {
        let site = match self {
            Sites::Fabric(places) => Site::Fabric(places[n]),
            Sites::Catenaries(numbers) => Site::Catenary(numbers[n]),
        };
        site.label(&scene.layup)
    }
}

/// A place that is nearest to the mold.
#[derive(Debug, Clone, Copy)]
struct Nearest {
    distance: f64,
    place: Point,
}

impl Shapes {
    /// The shapes of the steps up to `last` (from 0), of the catenaries and of a sheet.
    pub fn new(scene: &Scene, steps: &[Step], sheet: Option<&SheetShapes>, last: usize) -> Self {
        // points of the free curves of catenaries at each step
        let hanging = |step: &Step| match &step.catenaries {
            Some(catenaries) => {
                let places: Vec<Point> = step.grippers.iter().map(|g| g.position).collect();
                free_curves(
                    &scene.layup.ply,
                    &scene.layup.settings,
                    &places,
                    &catenaries.catenaries,
                )
            }
            None => Vec::new(),
        };
        let curves: Vec<_> = steps.iter().take(last + 1).map(hanging).collect();
        // steps compare point by point, so those whose catenaries have other free parts are left out
        let numbers = |curves: &[(usize, Vec<Point>)]| -> Vec<usize> {
            curves.iter().flat_map(|(n, points)| vec![*n; points.len()]).collect()
        };
        let sites = curves.first().map(|curves| numbers(curves)).unwrap_or_default();
        let states = curves.iter().enumerate().filter(|(_, curves)| numbers(curves) == sites);
        let states =
            states.map(|(k, c)| (k, c.iter().flat_map(|(_, points)| points.clone()).collect()));
        let states = states.collect();
        let catenaries = Series { sites: Sites::Catenaries(sites), states, least: Vec::new() };
        let mut series = Vec::new();
        if steps.iter().any(|step| step.catenaries.is_some()) {
            series.push(catenaries);
        }
        // nodes of a sheet are the same in all states of the same mesh
        if let Some(SheetShapes { places, states }) = sheet {
            let known =
                |(k, points): &&(usize, Vec<Point>)| *k <= last && points.len() == places.len();
            series.push(Series {
                sites: Sites::Fabric(places.clone()),
                states: states.iter().filter(known).cloned().collect(),
                least: Vec::new(),
            });
        }
        Shapes { series, tolerance: scene.layup.settings.contact.tolerance }
    }

    /// Whether nothing of the ply was recorded.
    pub fn is_empty(&self) -> bool {
        self.series.iter().all(|series| series.states.is_empty())
    }

    /// The first step, from 0, in which the ply is farther from all obstacles than bodies have to be: until then it may lie on one.
    pub fn clear_of_obstacles(&self, scene: &Scene) -> usize {
        let boxes: Vec<_> = scene
            .layup
            .bodies
            .obstacles()
            .iter()
            .map(|obstacle: &Obstacle| (&obstacle.pose, obstacle.shape.bounds()))
            .collect();
        let near = |point: &Point| {
            boxes.iter().any(|(pose, [low, high])| {
                let p = pose.local(*point);
                let off = [0, 1, 2].map(|c| (low[c] - p[c]).max(p[c] - high[c]).max(0.0));
                norm(off) < scene.limits.least(Name::Clearance)
            })
        };
        let clear = |series: &Series| {
            let mut states = series.states.iter();
            let first = states.find(|(_, points)| !points.iter().any(near));
            let last = series.states.last().map_or(0, |(k, _)| k + 1);
            first.map_or(last, |(k, _)| *k)
        };
        match boxes.is_empty() {
            true => 0,
            false => self.series.iter().map(clear).max().unwrap_or(0),
        }
    }

    /// Measures how far the ply is from the mold in the plan.
    pub fn measure(&mut self, scene: &Scene) {
        let Some(mold) = &scene.layup.mold else { return };
        for Series { states, least, .. } in &mut self.series {
            let bounds = |pair: &[(usize, Vec<Point>)]| -> Vec<f64> {
                let ways = pair[0].1.iter().zip(&pair[1].1);
                ways.map(|(a, b)| least_distance(mold, *a, *b, self.tolerance)).collect()
            };
            *least = states.par_windows(2).map(bounds).collect();
        }
    }

    /// The first part of the ply that would touch the mold where each step is moved, and does not in the plan.
    pub fn touches(&self, scene: &Scene, moved: &[Moved]) -> Option<Error> {
        let mold = scene.layup.mold.as_ref()?;
        let first = self.series.iter().filter_map(|series| {
            let pairs = series.states.windows(2).zip(&series.least);
            let mut found = pairs.filter_map(|(pair, least)| {
                let [a, b] = [&pair[0], &pair[1]];
                let ways = [&moved[a.0], &moved[b.0]];
                if ways.iter().all(|way| way.is_nothing()) {
                    return None;
                }
                let shortfall = |n: usize| {
                    let ends = [a.1[n], b.1[n]];
                    let [p, q] = [0, 1].map(|k| norm(ways[k].displacement(ends[k])));
                    if least[n] - p.max(q) > self.tolerance {
                        return None;
                    }
                    let places = [ways[0].place(ends[0]), ways[1].place(ends[1])];
                    let found = nearest(mold, places[0], places[1], self.tolerance)?;
                    // what comes as near in the plan is about to land
                    let planned = nearest(mold, ends[0], ends[1], self.tolerance);
                    planned.is_none().then_some((n, found))
                };
                let touching = (0..a.1.len()).into_par_iter().filter_map(shortfall);
                let worst = touching
                    .min_by(|x, y| x.1.distance.total_cmp(&y.1.distance).then(x.0.cmp(&y.0)))?;
                Some((b.0, worst))
            });
            found.next().map(|(step, worst)| (step, worst, &series.sites))
        });
        let (step, (n, Nearest { distance, place }), sites) = first.min_by_key(|found| found.0)?;
        Some(Error::ReplanTouches {
            at: sites.label(n, scene),
            step: step + 1,
            place,
            distance_mm: 1e3 * distance,
            tolerance_mm: 1e3 * self.tolerance,
        })
    }
}

/// The distance of a point from the mold (m), and whether there is mold below it.
fn distance_from(mold: &Mold, p: Point) -> (f64, bool) {
    let found = mold.separation(p, f64::INFINITY);
    (found.distance, !found.beyond)
}

/// A lower bound of the distance of all points of a straight way from the mold (m), half of the best one or more; parts up to `resolution` (m)
/// count by their ends.
fn least_distance(mold: &Mold, a: Point, b: Point, resolution: f64) -> f64 {
    let (ends, mut least) = ([a, b].map(|p| distance_from(mold, p).0), f64::INFINITY);
    let mut best = ends[0].min(ends[1]);
    let mut open = vec![([a, b], ends)];
    while let Some(([a, b], [da, db])) = open.pop() {
        let length = distance(a, b);
        let bound = 0.5 * (da + db - length);
        if bound >= TUNING.loose * best || length <= resolution || !length.is_finite() {
            least = least.min(bound);
            continue;
        }
        let middle = between(a, b, 0.5);
        let dm = distance_from(mold, middle).0;
        best = best.min(dm);
        open.push(([a, middle], [da, dm]));
        open.push(([middle, b], [dm, db]));
    }
    least
}

/// The nearest point of a straight way that touches the mold, closer than `tolerance` (m); `None` if none does.
fn nearest(mold: &Mold, a: Point, b: Point, tolerance: f64) -> Option<Nearest> {
    let mut found: Option<Nearest> = None;
    let mut see = |place: Point| {
        let (distance, on_mold) = distance_from(mold, place);
        let nearer = found.is_none_or(|best| distance < best.distance);
        if on_mold && distance <= tolerance && nearer {
            found = Some(Nearest { distance, place });
        }
        distance
    };
    let ends = [a, b].map(&mut see);
    let mut open = vec![([a, b], ends)];
    while let Some(([a, b], [da, db])) = open.pop() {
        let length = distance(a, b);
        if 0.5 * (da + db - length) > tolerance || length <= tolerance || !length.is_finite() {
            continue;
        }
        let middle = between(a, b, 0.5);
        let dm = see(middle);
        open.push(([a, middle], [da, dm]));
        open.push(([middle, b], [dm, db]));
    }
    found
}
