//! The verdict over a sample of cells: drapes, each of a cell with errors of its own and from a shared flight on, until they decide.

use super::Judged;
use super::drape::judge_seen;
use super::flight::Flight;
use super::turning::{Turning, Turns};
use crate::errors::{Draw, Errors};
use crate::layup::Layup;
use crate::measure::{Limits, Verdict};
use crate::ply::Neighbors;
use crate::scene::Scene;
use crate::state::{PlyState, Site};
use rayon::prelude::*;
use statrs::distribution::{Binomial, DiscreteCDF};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, OnceLock, PoisonError};

/// A sample is accepted before its last cell if none has failed and the share of all cells keeps every limit with this confidence.
const CONFIDENCE: f64 = 0.95;

/// What a measure that is no number has for a ratio, so that a file can hold it.
const LARGEST_RATIO: f64 = 1e6;

/// Whether a drape goes on, and how far a sample has come.
pub struct Watch<'a> {
    /// Asked before each time step whether to end.
    pub stop: &'a (dyn Fn() -> bool + Sync),
    /// Called with how many of at most this many drapes are done.
    pub done: &'a (dyn Fn(usize, usize) + Sync),
}

/// The verdict over a sample of cells.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct SampleVerdict {
    /// The errors of the cells.
    pub errors: Errors,
    /// How many cells of the whole sample must keep every limit.
    pub needed: usize,
    /// Whether it is accepted: as many cells as needed keep every limit, or all of the first ones do and these are enough
    /// ([`Errors::decided`]).
    pub ok: bool,
    /// Confidence (0 to 1) that the share of all possible cells keeps every limit if `ok`, and that fewer do if not.
    pub confidence: f64,
    /// Every limit, judged by the value that the share of the cells keeps which must keep it.
    pub limits: Vec<Verdict>,
    /// Each cell's drape, up to the one that decides.
    pub cells: Vec<CellVerdict>,
    /// Where the sheet is highest by the height that the share of the cells keeps there; `None` for catenaries.
    pub highest: Option<Highest>,
    /// Height (mm) at each node of the sheet that the share of the cells keeps, in four digits; empty of catenaries.
    pub spread_mm: Vec<f64>,
}

/// The drape of one cell.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct CellVerdict {
    /// Whether it keeps every limit.
    pub accepted: bool,
    /// The largest height of its sheet at the end (mm); `None` for catenaries and of a drape without an end.
    pub height_mm: Option<f64>,
    /// The largest ratio of a measure to its limit; above 1 it is not kept. A measure that is no number has 1e6.
    pub ratio: f64,
}

/// The highest place of a sample.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Highest {
    /// Height (mm).
    pub height_mm: f64,
    /// Fabric coordinates (mm).
    pub uv_mm: [f64; 2],
    /// The nearest line of grippers, from its first to its last.
    pub line: String,
    /// The nearest gripper.
    pub gripper: String,
}

/// The drapes of a sample so far.
#[derive(Default)]
struct Row {
    /// Drapes of the first cells, in their order.
    drapes: Vec<CellDrape>,
    /// How many of these keep every limit.
    kept: usize,
    /// Drapes of cells that come after one that is not done.
    waiting: BTreeMap<usize, CellDrape>,
}

/// A sample of cells that are not judged by their tilt rates, because their motion may take another time.
#[derive(Debug)]
pub(crate) struct Timeless {
    verdict: SampleVerdict,
    /// The cells of the verdict.
    drapes: Vec<CellDrape>,
}

/// One drape of a sample.
#[derive(Debug)]
pub(super) struct CellDrape {
    /// Its limits, but that of the tilt rate if it is not judged by that.
    pub judged: Judged,
    /// How its grippers turn.
    turning: Turning,
    /// Height of each node at the end (m); beyond the boundary of the mold 0. Empty of catenaries.
    heights: Vec<f64>,
    places: Vec<[f64; 2]>,
}

impl Errors {
    /// How many of this many cells must keep the limits.
    #[must_use]
    pub fn needed(&self, samples: usize) -> usize {
        // a share that is a whole number of cells but for rounding is that number
        ((self.share * samples as f64 * (1.0 - 1e-12)).ceil() as usize)
            .clamp(usize::from(samples > 0), samples)
    }

    /// Whether a sample is accepted, if that is decided when `kept` of its first `cells` cells keep every limit.
    ///
    /// It is accepted once as many cells as must keep every limit do, or once all of n cells do and `share^n <= 1 - 0.95`. It is
    /// refused once this many have failed that the rest is too small.
    #[must_use]
    pub fn decided(&self, kept: usize, cells: usize) -> Option<bool> {
        let needed = self.needed(self.samples);
        let sure = kept == cells && self.share.powf(cells as f64) <= 1.0 - CONFIDENCE;
        let refused = cells - kept > self.samples - needed;
        (kept >= needed || sure || refused).then_some(!refused)
    }

    /// Confidence of the verdict that `kept` of `cells` cells give: that at least the share of all possible cells keeps every limit
    /// if the sample is accepted (`ok`), and that fewer do if not.
    ///
    /// If just the share did, it is the probability that more cells than here would fail, or that more than here would keep every
    /// limit. The number of cells counts as chosen before, although it is that at which the sample ended.
    #[must_use]
    pub fn confidence(&self, kept: usize, cells: usize, ok: bool) -> f64 {
        let (chance, count) =
            if ok { (1.0 - self.share, cells - kept) } else { (self.share, kept) };
        Binomial::new(chance, cells as u64).map_or(0.0, |law| law.sf(count as u64))
    }

    /// The verdict over the sample of a scene along its motion, in its time; `None` if it was stopped.
    ///
    /// Cells are begun in their order, one a core, and none any more once those before it decide.
    #[must_use]
    pub fn judge(&self, scene: &Scene, watch: &Watch) -> Option<SampleVerdict> {
        let in_time = |drape: &mut CellDrape| drape.judge_turning(&scene.layup, &scene.limits);
        self.judge_cells(scene, watch, in_time).map(|sample| sample.verdict)
    }

    /// As [`Errors::judge`], without the tilt rate.
    pub(super) fn judge_timeless(&self, scene: &Scene, watch: &Watch) -> Option<Timeless> {
        self.judge_cells(scene, watch, |_| ())
    }

    /// As [`Errors::judge`]; `also` judges each drape further.
    fn judge_cells(
        &self,
        scene: &Scene,
        watch: &Watch,
        also: impl Fn(&mut CellDrape) + Sync,
    ) -> Option<Timeless> {
        let (row, verdict) = (Mutex::new(Row::default()), OnceLock::new());
        let done = AtomicUsize::new(0);
        let open = || verdict.get().is_none();
        let flight = Flight::new(&scene.layup, &scene.limits, &|| (watch.stop)());
        // cells end in any order, but count in theirs, so that the verdict does not depend on the number of threads
        let drape = |sample: usize| {
            let stop = || !open() || (watch.stop)();
            let cell = self.cell(scene, sample, 1.0);
            let Some(mut drape) = draped(&cell, flight.as_ref(), &stop) else { return };
            also(&mut drape);
            (watch.done)(done.fetch_add(1, Ordering::Relaxed) + 1, self.samples);
            let row = &mut *row.lock().unwrap_or_else(PoisonError::into_inner);
            row.waiting.insert(sample, drape);
            while open()
                && let Some(next) = row.waiting.remove(&row.drapes.len())
            {
                row.kept += usize::from(next.judged.accepted());
                row.drapes.push(next);
                if let Some(ok) = self.decided(row.kept, row.drapes.len()) {
                    verdict.get_or_init(|| ok);
                }
            }
        };
        // one cell a core; none is begun once the verdict is known
        (0..self.samples).take_while(|_| open()).par_bridge().for_each(drape);

        // each limit is reported at the rank that the share of accepted cells asks for
        let ok = *verdict.get()?;
        let Row { drapes, kept, .. } = row.into_inner().unwrap_or_else(PoisonError::into_inner);
        let rank = self.needed(drapes.len());
        let spread = spread(&drapes, rank);
        let verdict = SampleVerdict {
            errors: *self,
            needed: self.needed(self.samples),
            ok,
            confidence: self.confidence(kept, drapes.len(), ok),
            limits: limits(&drapes, rank),
            cells: drapes.iter().map(cell_verdict).collect(),
            highest: highest(scene, &drapes[0].places, &spread),
            spread_mm: spread.iter().map(|height| in_digits(height * 1e3)).collect(),
        };
        Some(Timeless { verdict, drapes })
    }

    /// The scene of a cell with all errors larger by a factor.
    pub(super) fn cell(&self, scene: &Scene, sample: usize, factor: f64) -> Scene {
        let draw: Draw = self.draw(sample, scene.layup.ply.grippers());
        Scene { layup: draw.scaled(factor).apply(&scene.layup), errors: None, ..scene.clone() }
    }
}

impl SampleVerdict {
    /// Cells that keep every limit.
    #[must_use]
    pub fn accepted(&self) -> usize {
        self.cells.iter().filter(|cell| cell.accepted).count()
    }

    /// Largest height (mm) that the share of the cells keeps which must keep the limits; `None` for catenaries.
    #[must_use]
    pub fn height_mm(&self) -> Option<f64> {
        let mut heights: Vec<f64> = self.cells.iter().filter_map(|cell| cell.height_mm).collect();
        heights.sort_by(f64::total_cmp);
        // a drape without an end has no height: it counts as the highest
        heights.get(self.errors.needed(self.cells.len()).max(1) - 1).copied()
    }
}

impl Timeless {
    /// The verdict without the tilt rate.
    pub fn verdict(self) -> SampleVerdict {
        self.verdict
    }

    /// Whether the share of the cells keeps all other limits.
    pub fn ok(&self) -> bool {
        self.verdict.ok
    }

    /// The cells that keep all other limits.
    fn accepted(&self) -> impl Iterator<Item = &CellDrape> {
        self.drapes.iter().filter(|drape| drape.judged.accepted())
    }

    /// How far their grippers turn from step to step.
    pub fn turns(&self) -> Turns {
        Turns::most(self.accepted().map(|drape| &drape.turning))
    }

    /// The largest tilt rate of those cells as a share of its limit, along the motion of a layup in its time; at most 1 if all keep it.
    pub fn fastest(&self, layup: &Layup, limits: &Limits) -> f64 {
        let rates = self.accepted().filter_map(|drape| drape.turning.judge(layup, limits));
        rates
            .map(|rate| if rate.ok { rate.ratio().min(1.0) } else { rate.ratio() })
            .fold(0.0, f64::max)
    }

    /// The verdict with the tilt rate along the motion of a layup, in a time in which those cells keep that limit.
    pub fn in_time(self, layup: &Layup, limits_of: &Limits) -> SampleVerdict {
        let Timeless { verdict, mut drapes } = self;
        drapes.iter_mut().for_each(|drape| drape.judge_turning(layup, limits_of));
        SampleVerdict {
            limits: limits(&drapes, verdict.errors.needed(drapes.len())),
            cells: drapes.iter().map(cell_verdict).collect(),
            ..verdict
        }
    }
}

impl CellDrape {
    /// Judges it by its tilt rate too, along the motion of a layup in its time.
    fn judge_turning(&mut self, layup: &Layup, limits: &Limits) {
        self.judged.limits.extend(self.turning.judge(layup, limits));
    }
}

/// A drape by the model that decides, from a flight on if there is one; `None` if it was stopped.
pub(super) fn draped(
    scene: &Scene,
    flight: Option<&Flight>,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<CellDrape> {
    if stop() {
        return None;
    }
    let Scene { layup, limits, .. } = scene;
    let mut turning = Turning::default();
    let see = &mut |ply: &PlyState| turning.see(ply);
    let Ok(found) = judge_seen(layup, limits, usize::MAX, flight, &|| stop(), see) else {
        // the errors have left no sheet that could be draped
        return Some(CellDrape {
            judged: Judged::nothing(),
            turning,
            heights: Vec::new(),
            places: Vec::new(),
        });
    };
    let (judged, sheet) = found;
    if judged.interrupted {
        return None;
    }
    let Some(drape) = sheet else {
        return Some(CellDrape { judged, turning, heights: Vec::new(), places: Vec::new() });
    };
    let lies_on = |node: usize| {
        let mold = drape.sheet.mold.as_ref();
        mold.is_some_and(|mold| !mold.closest_point(drape.last.positions[node]).beyond)
    };
    let heights = drape.last.heights.iter().enumerate();
    let heights = heights.map(|(n, height)| if lies_on(n) { height.max(0.0) } else { 0.0 });
    Some(CellDrape {
        judged,
        turning,
        heights: heights.collect(),
        places: drape.sheet.fabric.places.clone(),
    })
}

fn cell_verdict(drape: &CellDrape) -> CellVerdict {
    let Judged { limits, missing, .. } = &drape.judged;
    let highest = drape.heights.iter().copied().reduce(f64::max);
    CellVerdict {
        accepted: drape.judged.accepted(),
        height_mm: highest.filter(|_| *missing == 0.0).map(|height| height * 1e3),
        ratio: limits.iter().map(Verdict::ratio).fold(0.0, f64::max).min(LARGEST_RATIO),
    }
}

/// Every limit, judged by the drape at this rank: as many keep the limit as well or better.
fn limits(drapes: &[CellDrape], needed: usize) -> Vec<Verdict> {
    let mut names: Vec<_> = Vec::new();
    for verdict in drapes.iter().flat_map(|drape| &drape.judged.limits) {
        if !names.contains(&verdict.name) {
            names.push(verdict.name);
        }
    }
    let verdict_of = |name| {
        let verdicts =
            drapes.iter().flat_map(|drape| drape.judged.limits.iter().find(|v| v.name == name));
        let mut found: Vec<&Verdict> = verdicts.collect();
        found.sort_by(|a, b| a.ratio().total_cmp(&b.ratio()));
        found.get(needed.min(found.len()).max(1) - 1).map(|verdict| (*verdict).clone())
    };
    names.into_iter().filter_map(verdict_of).collect()
}

/// Height (m) at each node that this many drapes keep.
fn spread(drapes: &[CellDrape], needed: usize) -> Vec<f64> {
    let nodes = drapes.iter().map(|drape| drape.heights.len()).min().unwrap_or(0);
    let height_of = |node: usize| {
        let mut heights: Vec<f64> = drapes.iter().map(|drape| drape.heights[node]).collect();
        heights.sort_by(f64::total_cmp);
        heights[needed.max(1) - 1]
    };
    (0..nodes).map(height_of).collect()
}

/// A number in four digits, which is enough for a picture and short in a file.
fn in_digits(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// Distance of a place from the line between two others in the fabric (m).
fn off_line([u, v]: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let way = [b[0] - a[0], b[1] - a[1]];
    let (off, square) = ([u - a[0], v - a[1]], way[0] * way[0] + way[1] * way[1]);
    let t = ((off[0] * way[0] + off[1] * way[1]) / square).clamp(0.0, 1.0);
    (off[0] - t * way[0]).hypot(off[1] - t * way[1])
}

/// The highest node, with the two neighboring grippers whose line, and the gripper that, is nearest in the fabric.
fn highest(scene: &Scene, places: &[[f64; 2]], spread: &[f64]) -> Option<Highest> {
    let (node, height) = spread.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1))?;
    let (place, ply) = (places[node], &scene.layup.ply);
    let away = |n: &usize| {
        let [u, v] = ply.place(*n);
        (place[0] - u).hypot(place[1] - v)
    };
    let gripper = (0..ply.grippers()).min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let off = |line: &Neighbors| off_line(place, line.grippers.map(|n| ply.place(n)));
    let lines = ply.neighbors();
    let line = lines.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    let label = |n: usize| Site::Gripper(n).label(&scene.layup);
    let [from, to] = line.map_or([gripper; 2], |line| line.grippers).map(label);
    Some(Highest {
        height_mm: height * 1e3,
        uv_mm: place.map(|c| c * 1e3),
        line: format!("{from} to {to}"),
        gripper: label(gripper),
    })
}
