//! How a drape of the sheet came out.

use super::super::drape::Status;
use super::super::event::Event;
use super::super::model::Sheet;
use super::super::state::State;
use super::direction::directions;
use super::extremes::Extremes;
use super::height::{Raised, raised};
use super::limits::limits;
use super::position::positions;
use super::{Most, Place};
use crate::measure::Verdict;
use crate::scene::Scene;

/// Height (m) whose share of the area is reported; half a millimeter, the limit unless a scene sets another.
const HEIGHT_OF_SHARE: f64 = 5e-4;

/// The outcome of a drape of the sheet. Values that need a mold or an ideal drape are none without it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Summary {
    /// Every limit holds, and every step was solved.
    pub accepted: bool,
    /// How the drape ended.
    pub status: Status,
    /// Whether every step was solved and the ply is at rest.
    pub converged: bool,
    /// Nodes.
    pub nodes: usize,
    /// Steps done.
    pub steps: usize,
    /// Largest height over the mold at the end (mm).
    pub height_max_mm: Option<f64>,
    /// Root mean square of the height over the area (mm).
    pub height_rms_mm: Option<f64>,
    /// Share of the area that is higher than half a millimeter.
    pub height_share_above_half_mm: Option<f64>,
    /// Largest height of a ridge, where excess length is caught (mm).
    pub ridge_max_mm: Option<f64>,
    /// Largest height of a bridge, where the fabric is taut over a hollow (mm).
    pub bridge_max_mm: Option<f64>,
    /// Largest angle of a fiber out of the mold's plane (°).
    pub out_of_plane_deg: Option<f64>,
    /// Largest angle of a fiber along the mold against the ideal drape (°).
    pub fibre_angle_deg: Option<f64>,
    /// Largest distance of a landed point from its ideal place (mm).
    pub position_max_mm: Option<f64>,
    /// Root mean square of it over the landed area (mm).
    pub position_rms_mm: Option<f64>,
    /// Largest strain of a yarn in any step.
    pub strain_max: f64,
    /// Largest shear angle in any step (°).
    pub shear_max_deg: f64,
    /// Largest force of the ply on a gripper in any step (N).
    pub gripper_force_max_n: f64,
    /// Its largest horizontal part (N).
    pub gripper_pull_max_n: f64,
    /// How far fabric has slid under a pad at most (mm); none where pads hold whatever pulls.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub slip_max_mm: Option<f64>,
    /// Largest tilt of a pad, or of the ply at a gripper without one, in any step (°).
    pub tilt_max_deg: f64,
    /// Sharpest turn between neighboring segments in the air in any step (°).
    pub fold_max_deg: f64,
    /// Largest depth of ply and grippers in the mold in any step (mm).
    pub penetration_mm: Option<f64>,
    /// First step in which the ply touches the mold.
    pub first_contact_step: Option<usize>,
    /// Fabric coordinates of what touches first (mm).
    pub first_contact_uv_mm: Option<[f64; 2]>,
    /// Energy at the end (J): weight, stretch, shear, bending, contact and mounts.
    pub energy_j: f64,
    /// Kinetic energy at the end (J).
    pub kinetic_energy_j: f64,
    /// Time steps.
    pub time_steps: usize,
    /// Linear systems that were solved.
    pub solves: usize,
    /// Shortest time step as a share of a step of the motion.
    pub smallest_step: f64,
    /// Every limit, judged.
    pub limits: Vec<Verdict>,
    /// When pads grip, press and let go, in the order of time; nothing where they hold to the end.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub events: Vec<Event>,
}

/// What a drape took.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct Effort {
    /// Time steps.
    pub time_steps: usize,
    /// Linear systems that were solved.
    pub solves: usize,
    /// Shortest time step as a share of a step of the motion.
    pub smallest_step: f64,
}

/// What is measured at the end.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Ends {
    pub height: Most,
    pub out_of_plane: Most,
    pub fibre_angle: Most,
    pub position: Most,
}

impl Summary {
    /// Of a drape that ended with a state; points up to `clear` (m) over the mold lie on it.
    pub(in super::super) fn new(
        scene: &Scene,
        sheet: &Sheet,
        clear: f64,
        extremes: &Extremes,
        last: &State,
        status: Status,
        effort: Effort,
    ) -> Self {
        let Effort { time_steps, solves, smallest_step } = effort;
        let mut ends = Ends::default();
        let (mut rms, mut share, mut ridge, mut bridge, mut position_rms) =
            (None, None, None, None, None);
        let fabric = &sheet.fabric;
        if let Some(mold) = &sheet.mold {
            let touching = scene.settings.contact.tolerance;
            let x = &last.positions;
            let (mut squares, mut above, mut area) = (0.0, 0.0, 0.0);
            for (node, height) in last.heights.iter().enumerate() {
                // what lies off the mold has no height, and what is beyond the boundary is no ply
                if !fabric.inside[node] || mold.closest_point(x[node]).beyond {
                    continue;
                }
                ends.height.meet(height.max(0.0), fabric.places[node], x[node], last.step);
                squares += fabric.areas[node] * height * height;
                area += fabric.areas[node];
                if *height > HEIGHT_OF_SHARE {
                    above += fabric.areas[node];
                }
            }
            for rim in fabric.rims.iter().flatten() {
                let at = rim.of(x);
                let closest = mold.closest_point(at);
                if !closest.beyond {
                    ends.height.meet(closest.distance.max(0.0), rim.place, at, last.step);
                }
            }
            if area > 0.0 {
                (rms, share) = (Some((squares / area).sqrt()), Some(above / area));
                let kinds = raised(fabric, mold, x, clear);
                let highest = |kind: Raised| {
                    let of = kinds.iter().zip(&last.heights).zip(&fabric.inside);
                    let of = of.filter(|((k, _), inside)| **inside && **k == Some(kind));
                    Some(of.map(|((_, height), _)| *height).fold(0.0, f64::max))
                };
                (ridge, bridge) = (highest(Raised::Ridge), highest(Raised::Bridge));
            }
            let ideal = scene.target.as_ref().and_then(|target| target.drape.as_deref());
            [ends.out_of_plane, ends.fibre_angle] = directions(fabric, mold, ideal, x, last.step);
            if let Some(ideal) = ideal {
                let landed = |node: usize| fabric.inside[node] && last.heights[node] <= touching;
                (ends.position, position_rms) =
                    positions(fabric, mold, ideal, x, landed, last.step);
            }
        }

        let converged = status == Status::Converged;
        let limits = limits(scene, extremes, &ends);
        let value = |most: Most, unit: f64| most.0.map(|place| place.value / unit);
        let degrees = |most: Most| most.0.map(|place| place.value.to_degrees());
        let mm = |value: Option<f64>| value.map(|value| value * 1e3);
        Summary {
            accepted: converged && limits.iter().all(|verdict| verdict.ok),
            status,
            converged,
            nodes: fabric.places.len(),
            steps: last.step,
            height_max_mm: value(ends.height, 1e-3),
            height_rms_mm: mm(rms),
            height_share_above_half_mm: share,
            ridge_max_mm: mm(ridge),
            bridge_max_mm: mm(bridge),
            out_of_plane_deg: degrees(ends.out_of_plane),
            fibre_angle_deg: degrees(ends.fibre_angle),
            position_max_mm: value(ends.position, 1e-3),
            position_rms_mm: mm(position_rms),
            strain_max: value(extremes.strain, 1.0).unwrap_or(0.0),
            shear_max_deg: degrees(extremes.shear).unwrap_or(0.0),
            gripper_force_max_n: value(extremes.force, 1.0).unwrap_or(0.0),
            gripper_pull_max_n: value(extremes.lateral, 1.0).unwrap_or(0.0),
            slip_max_mm: value(extremes.slide, 1e-3)
                .filter(|_| scene.settings.pad.slip_force.is_some()),
            tilt_max_deg: degrees(extremes.tilt).unwrap_or(0.0),
            fold_max_deg: degrees(extremes.fold).unwrap_or(0.0),
            penetration_mm: value(extremes.depth, 1e-3),
            first_contact_step: extremes.first_contact.map(|place| place.step),
            first_contact_uv_mm: extremes.first_contact.map(|place| place.uv.map(|c| c * 1e3)),
            energy_j: last.energy,
            kinetic_energy_j: last.kinetic_energy,
            time_steps,
            solves,
            smallest_step,
            limits,
            events: Vec::new(),
        }
    }

    /// Judges by another drape too, along the same motion with a step half-way between all its steps: a limit that it does
    /// not keep is not kept, and its verdict says so. What is measured stays as it is.
    pub(crate) fn judge_between(&mut self, between: &Summary) {
        for verdict in &mut self.limits {
            let other = between.limits.iter().find(|other| other.name == verdict.name);
            if let Some(other) = other.filter(|other| verdict.ok && !other.ok) {
                *verdict = Verdict {
                    // the steps of the motion are the odd ones of the other drape
                    step: other.step.map(|step| step / 2 + 1),
                    at: format!("{}, with steps half-way between all steps", other.at),
                    ..other.clone()
                };
            }
        }
        if self.converged && !between.converged {
            (self.status, self.converged) = (between.status, false);
        }
        self.accepted &= between.accepted;
    }
}

/// Where a value is, as a label.
pub(super) fn label(place: &Place) -> String {
    let [u, v] = place.uv.map(|c| c * 1e3);
    format!("fabric point ({u:.1}, {v:.1}) mm")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::{Name, Worst};

    /// A converged drape of five steps, or of nine with the steps between, whose height is judged.
    fn judged(steps: usize, height: f64) -> Summary {
        let worst = Worst { value: height, at: "fabric point (1.0, 2.0) mm".into(), place: None };
        let limits = vec![
            Verdict::of(Name::Height, worst.clone(), 0.5, Some(steps)),
            Verdict::of(Name::Position, worst, 2.0, Some(steps)),
        ];
        Summary {
            accepted: limits.iter().all(|verdict| verdict.ok),
            status: Status::Converged,
            converged: true,
            nodes: 4,
            steps,
            height_max_mm: Some(height),
            height_rms_mm: None,
            height_share_above_half_mm: None,
            ridge_max_mm: None,
            bridge_max_mm: None,
            out_of_plane_deg: None,
            fibre_angle_deg: None,
            position_max_mm: None,
            position_rms_mm: None,
            strain_max: 0.0,
            shear_max_deg: 0.0,
            gripper_force_max_n: 0.0,
            gripper_pull_max_n: 0.0,
            slip_max_mm: None,
            tilt_max_deg: 0.0,
            fold_max_deg: 0.0,
            penetration_mm: None,
            first_contact_step: None,
            first_contact_uv_mm: None,
            energy_j: 0.0,
            kinetic_energy_j: 0.0,
            time_steps: 1,
            solves: 1,
            smallest_step: 1.0,
            limits,
            events: Vec::new(),
        }
    }

    /// What is refused with steps between the steps is not accepted, by that limit alone; what it measured stays.
    #[test]
    fn a_drape_that_depends_on_its_steps_is_refused_by_the_limit_that_it_breaks() {
        let mut summary = judged(5, 0.4);
        summary.judge_between(&judged(9, 0.7));
        assert!(!summary.accepted && summary.height_max_mm == Some(0.4));
        let [height, position] = &summary.limits[..] else { panic!("two limits") };
        assert!(!height.ok && height.value == 0.7 && height.step == Some(5));
        assert!(height.at.ends_with("mm, with steps half-way between all steps"), "{}", height.at);
        assert!(position.ok && position.value == 0.4);

        let mut moves = judged(9, 0.4);
        (moves.status, moves.converged, moves.accepted) = (Status::NotAtRest, false, false);
        let mut summary = judged(5, 0.4);
        summary.judge_between(&moves);
        assert!(!summary.accepted && summary.status == Status::NotAtRest);

        let mut summary = judged(5, 0.4);
        summary.judge_between(&judged(9, 0.45));
        assert_eq!(summary, judged(5, 0.4));
    }
}
