//! How good a plan is: the complete drape along it, and how far its worst measure is from its limit.
//!
//! The model of the scene decides. A sheet is draped with a coarse mesh to rank candidates, with the scene's own where
//! that ranking led to no plan, and with this one to decide (`decision`).

use crate::Error;
use crate::clearance::Nearest;
use crate::errors::{Errors, RelativeError};
use crate::layup::{Layup, Model, SheetTime, Stepping};
use crate::measure::{Name, Unit, Verdict, Worst, Worth, clearance_found};
use crate::motion::{Attitudes, Motion, TimedMotion};
use crate::outcome::{self, Flight, Judged};
use crate::planner::search_state::SearchState;
use crate::planner::tuning::{PlannerTuning, TUNING};
use crate::scene::Scene;
use crate::sheet;
use rayon::prelude::*;

/// A layup as plans are evaluated in it, along another motion: with steps cut where the ply would penetrate the mold.
#[must_use]
pub fn along_motion(layup: &Layup, motion: Motion) -> Layup {
    let mut layup = Layup { motion, ..layup.clone() };
    layup.settings.contact.stepping = Stepping::Cut;
    layup
}

/// The mesh with which the sheet is draped to rank candidates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mesh {
    /// A coarse one, ten times as fast.
    Coarse,
    /// That of the scene.
    Own,
}

/// The drapes along planned positions: the one without errors, and those of cells with errors.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Drapes {
    /// The worst of all drapes, limit by limit.
    pub worst: Judged,
    /// Each of them, the one without errors first.
    pub each: Vec<Judged>,
    /// The first cell that breaks a limit and counts, if one does.
    pub refused_by: Option<usize>,
}

impl Drapes {
    /// The mean of all scores with what is known of the error of a mesh: a few cells say more of all others together than the worst
    /// of them alone.
    #[must_use]
    pub fn score(&self, bias: &Bias) -> f64 {
        let sum: f64 = self.each.iter().map(|judged| score_with(judged, bias)).sum();
        sum / self.each.len() as f64
    }
}

/// A complete drape without errors along planned positions of grippers, from whose flight cells with errors go on.
#[derive(Debug)]
pub struct Draped<'a> {
    scene: &'a Scene,
    layup: Layup,
    mesh: Mesh,
    nominal: Judged,
    flight: Option<Flight>,
}

impl<'a> Draped<'a> {
    /// The drape along planned positions of grippers (m), rounded as the motion will round them, of catenaries or a sheet; broken off where it
    /// needs too much or the search is stopped.
    ///
    /// # Errors
    /// The errors of [`outcome::judge`] if the model that decides cannot drape the scene.
    pub fn new(
        scene: &'a Scene,
        planned: &[Vec<[f64; 3]>],
        mesh: Mesh,
        state: &SearchState,
    ) -> Result<Self, Error> {
        let positions = rounded(planned);
        let times = (0..positions.len()).map(|n| n as f64).collect();
        let mut layup = along_motion(&scene.layup, Motion { times, positions });
        // a candidate begins where the ply hangs: none of its steps is one of the lift
        if let Some(pick_up) = &mut layup.pick_up {
            pick_up.lift_steps = 0;
        }
        let (limits, stop) = (&scene.limits, || state.report().is_break());
        match layup.settings.model {
            Model::Catenaries => {
                let most = TUNING.most_equilibria * planned.len();
                let nominal = outcome::judge(&layup, limits, most, &stop)?;
                Ok(Draped { scene, layup, mesh, nominal, flight: None })
            }
            Model::Sheet => {
                // cups that are in no rows along the yarns may be too near to each other for the lines of a coarse mesh
                let has_sheet = sheet::Sheet::new(&as_ranked(layup.clone(), mesh)).is_ok();
                let mesh = if has_sheet { mesh } else { Mesh::Own };
                let ranked = as_ranked(layup.clone(), mesh);
                let (nominal, flight) = Flight::judged(&ranked, limits, &stop)?;
                Ok(Draped { scene, layup, mesh, nominal: of_mesh(nominal, mesh), flight })
            }
        }
    }

    /// With the drapes of some cells with errors, as [`with_errors`]; catenaries are draped without errors only.
    #[must_use]
    pub fn in_cells(&self, cells: &[usize], spare: usize, state: &SearchState) -> Drapes {
        let is_sheet = self.layup.settings.model == Model::Sheet;
        let errors = self.scene.errors.filter(|_| is_sheet);
        with_errors(&self.layup, errors, self.nominal.clone(), cells, spare, |cell| {
            // the errors may have left no sheet that could be draped
            let (cell, stop) = (as_ranked(cell, self.mesh), || state.report().is_break());
            let judged = Flight::judge(self.flight.as_ref(), &cell, &self.scene.limits, &stop);
            Some(of_mesh(judged.unwrap_or_else(|_| Judged::nothing()), self.mesh))
        })
    }
}

/// The drape of a layup and those of some cells with errors. `drape` drapes a cell; it gives `None` if it was stopped. A drape that is far
/// from a plan is alone. As many cells as are to spare may break a limit, and do not count; behind one more only a few others are draped.
///
/// The cells are none of the sample by which the plan is judged in the end, so that this judges what was not planned for.
pub fn with_errors(
    layup: &Layup,
    errors: Option<Errors>,
    nominal: Judged,
    cells: &[usize],
    mut spare: usize,
    drape: impl Fn(Layup) -> Option<Judged> + Sync,
) -> Drapes {
    let mut drapes = Drapes { worst: nominal.clone(), each: vec![nominal], refused_by: None };
    // a drape that fails far without errors is not saved by any cell
    let Some(errors) = errors.filter(Errors::is_drawn) else { return drapes };
    if score(&drapes.worst) > TUNING.far {
        return drapes;
    }
    let cell = |sample: &usize| Some((*sample, drape(planned_cell(errors, *sample, layup))?));
    // by batches of a fixed size, so that the number of cells does not depend on the threads
    for batch in cells.chunks(TUNING.batch) {
        let judged: Vec<(usize, Judged)> = batch.par_iter().filter_map(cell).collect();
        for (sample, judged) in judged {
            match (judged.accepted(), spare) {
                (true, _) => worsen(&mut drapes.worst, &judged),
                (false, 0) => {
                    worsen(&mut drapes.worst, &judged);
                    drapes.refused_by = drapes.refused_by.or(Some(sample));
                }
                (false, _) => spare -= 1,
            }
            drapes.each.push(judged);
        }
        if drapes.refused_by.is_some() {
            break;
        }
    }
    drapes
}

/// Makes of a drape the worse of it and another, limit by limit.
fn worsen(worst: &mut Judged, other: &Judged) {
    for verdict in &other.limits {
        match worst.limits.iter_mut().find(|limit| limit.name == verdict.name) {
            Some(limit) if verdict.ratio() > limit.ratio() => *limit = verdict.clone(),
            Some(_) => {}
            None => worst.limits.push(verdict.clone()),
        }
    }
    worst.complete &= other.complete;
    worst.missing = worst.missing.max(other.missing);
    worst.unsolved += other.unsolved;
}

/// The ends of its scatter at which the ply of the first cells is.
pub const ENDS: [f64; 2] = [1.0, -1.0];

/// The layup of a cell that a plan is made with: of another seed than the sample by which it is judged in the end. In the first the ply is as
/// stiff in shear and as light as hardly one of twenty, and in the second as limp and as heavy.
#[must_use]
pub fn planned_cell(errors: Errors, sample: usize, layup: &Layup) -> Layup {
    let planned = Errors { seed: !errors.seed, ..errors };
    let mut draw = planned.draw(sample, layup.ply.grippers());
    if let Some(sign) = ENDS.get(sample) {
        draw.material.shear = RelativeError::Share(errors.material.shear.extreme(*sign));
        let mass = errors.material.areal_mass.extreme(-sign);
        draw.material.areal_mass = RelativeError::Share(mass);
    }
    draw.apply(layup)
}

/// A layup as it is draped to rank a candidate.
pub fn as_ranked(mut layup: Layup, mesh: Mesh) -> Layup {
    if mesh == Mesh::Coarse {
        let (pitch, radius) = (sheet::pitch(&layup.ply), layup.settings.pad.radius);
        let coarse = (TUNING.mesh * pitch).min(sheet::coarsest_mesh(pitch, radius));
        let own = layup.settings.sheet.mesh.unwrap_or(0.0);
        layup.settings.sheet.mesh = Some(own.max(coarse));
    }
    // in its own time a motion is draped once it has one, and only then pads can dwell on the way
    layup.settings.sheet.time = SheetTime::QuasiStatic;
    if let Some(release) = &mut layup.release {
        release.dwell = 0.0;
    }
    layup
}

/// What counts of a drape with one of the meshes.
fn of_mesh(mut judged: Judged, mesh: Mesh) -> Judged {
    if mesh == Mesh::Coarse {
        // forces at grippers that hold a point are those of the lines beside it, and far larger where these are far apart
        judged.limits.retain(|verdict| verdict.name.measure().unit() != Unit::NEWTON);
    }
    judged
}

/// A judgment with one more limit in place of an earlier one on the same measure.
#[must_use]
pub fn also(mut drape: Judged, verdict: Option<Verdict>) -> Judged {
    if let Some(verdict) = verdict {
        drape.limits.retain(|other| other.name != verdict.name);
        drape.limits.push(verdict);
    }
    drape
}

/// The verdict on the nearest pair of bodies, which is nearest on the way to a step.
#[must_use]
pub fn clearance_verdict(scene: &Scene, nearest: &Nearest, step: usize) -> Verdict {
    let worst = Worst::new(&clearance_found(nearest, nearest.time), &scene.layup);
    let limit = scene.limits.least(Name::Clearance) * 1e3;
    Verdict::new(Name::Clearance, worst, limit, Some(step))
}

/// The verdict on the nearest pair of bodies along the whole of a motion in time, with pads turned as the motion file will say; `None` if the
/// scene has no bodies.
#[must_use]
pub fn clearance_of_motion(
    scene: &Scene,
    motion: &TimedMotion,
    attitudes: &Attitudes,
) -> Option<Verdict> {
    let least = scene.limits.least(Name::Clearance);
    let rate = motion.fitting_rate(scene.plan.rate);
    let nearest = Nearest::of_motion(&scene.layup, least, rate, motion, attitudes)?;
    let step = motion.times().partition_point(|t| *t < nearest.time) + 1;
    Some(clearance_verdict(scene, &nearest, step.min(motion.times().len())))
}

/// Where a cubic B-spline passes the planned positions (m), which are its control points, if its knots are evenly
/// spaced: nearly what [`crate::motion::TimedMotion`] makes of them, without its search for the spacing.
#[must_use]
pub fn rounded(planned: &[Vec<[f64; 3]>]) -> Vec<Vec<[f64; 3]>> {
    let mut out = planned.to_vec();
    for (k, around) in planned.windows(3).enumerate() {
        for (n, place) in out[k + 1].iter_mut().enumerate() {
            let [before, here, after] = [around[0][n], around[1][n], around[2][n]];
            *place = [0, 1, 2].map(|c| (before[c] + 4.0 * here[c] + after[c]) / 6.0);
        }
    }
    out
}

/// What a limit adds to the score. A limit that only has to be kept counts from a share of it on; of the errors of the
/// ply, less is always better.
fn weight(verdict: &Verdict, bias: f64) -> f64 {
    let (ratio, counted) = (bias * verdict.ratio(), TUNING.counted_share);
    match verdict.name.measure().worth() {
        Worth::Kept if ratio <= 1.0 => ((ratio - counted) / (1.0 - counted)).max(0.0),
        _ => ratio,
    }
}

/// By how much measures of a coarse sheet differ from those of a fine one: a factor for each that was compared.
#[derive(Debug, Clone, Default)]
pub struct Bias(Vec<(Name, f64)>);

impl Bias {
    /// Learns from two drapes along one plan.
    pub fn learn(&mut self, coarse: &Judged, fine: &Judged) {
        for a in &coarse.limits {
            let Some(b) = fine.limits.iter().find(|b| b.name == a.name) else { continue };
            let most = TUNING.largest_bias;
            let factor = (b.ratio() / a.ratio().max(f64::MIN_POSITIVE)).clamp(1.0 / most, most);
            // two ratios without end say nothing of each other
            if factor.is_nan() {
                continue;
            }
            match self.0.iter_mut().find(|(name, _)| *name == a.name) {
                Some((_, before)) => *before = (*before * factor).sqrt(),
                None => self.0.push((a.name, factor)),
            }
        }
    }

    /// Whether nothing was learned.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn factor(&self, name: Name) -> f64 {
        self.0.iter().find(|(other, _)| *other == name).map_or(1.0, |(_, factor)| *factor)
    }
}

/// The worst ratio, and a little of the mean; smaller is better, and above 1 plus the weight of the mean nothing is accepted.
#[must_use]
pub fn score(drape: &Judged) -> f64 {
    score_with(drape, &Bias::default())
}

/// The score of a drape of a coarse sheet, corrected by what is known of its error.
#[must_use]
pub fn score_with(drape: &Judged, bias: &Bias) -> f64 {
    let ratios: Vec<f64> = drape.limits.iter().map(|v| weight(v, bias.factor(v.name))).collect();
    let worst = ratios.iter().copied().fold(0.0, f64::max);
    let PlannerTuning { mean_weight, missing_weight, .. } = TUNING;
    let mean = ratios.iter().sum::<f64>() / ratios.len().max(1) as f64;
    // a drape that was broken off is worse than any other, the more so the earlier it was broken off
    let missing = drape.missing;
    worst
        + mean_weight * mean
        + drape.unsolved as f64
        + if missing > 0.0 { missing_weight * (1.0 + missing) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A search prefers a plan that misses a limit to one with a step that is no solution, and any whole one to one broken off.
    #[test]
    fn an_unsolved_step_costs_a_search_more_than_a_limit() {
        let slack = |value: f64| {
            let worst = Worst { value, at: String::new(), place: None };
            Verdict::new(Name::SlackRatio, worst, 5e-4, Some(1))
        };
        let evaluated = |value: f64, unsolved: usize, missing: f64| {
            score(&Judged {
                limits: vec![slack(value)],
                complete: missing == 0.0,
                missing,
                unsolved,
                interrupted: false,
                effort: None,
            })
        };
        let sound = evaluated(4e-4, 0, 0.0);
        assert!(sound < 1.0);
        assert!((evaluated(4e-4, 2, 0.0) - sound - 2.0).abs() < 1e-12);
        assert!(evaluated(4e-4, 0, 0.1) > evaluated(1e-1, 30, 0.0));
    }

    /// What a fine sheet says of one plan corrects what a coarse one says of others: a height that was 0.3 mm instead of 0.24 mm
    /// makes 0.36 mm into 0.45 mm. A second comparison counts as much as the first, and no factor is beyond its bounds.
    #[test]
    fn a_ranking_learns_from_decisions() {
        let height = |value: f64| {
            let worst = Worst { value, at: String::new(), place: None };
            let limits = vec![Verdict::new(Name::Height, worst, 0.5, Some(1))];
            Judged {
                limits,
                complete: true,
                missing: 0.0,
                unsolved: 0,
                interrupted: false,
                effort: None,
            }
        };
        let mut bias = Bias::default();
        bias.learn(&height(0.24), &height(0.30));
        let corrected = score_with(&height(0.36), &bias);
        assert!((corrected - score(&height(0.45))).abs() < 1e-12, "{corrected}");
        bias.learn(&height(0.3), &height(0.3));
        assert!((bias.factor(Name::Height) - 1.25_f64.sqrt()).abs() < 1e-12, "{bias:?}");
        let mut wild = Bias::default();
        wild.learn(&height(0.1), &height(5.0));
        assert_eq!(wild.factor(Name::Height), TUNING.largest_bias);
        assert_eq!(wild.factor(Name::Position), 1.0);
        let mut lost = Bias::default();
        lost.learn(&height(f64::NAN), &height(f64::INFINITY));
        assert!(lost.is_empty());
    }
}
