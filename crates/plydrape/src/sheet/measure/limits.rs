//! Limits of the sheet, judged.

use super::Most;
use super::extremes::Extremes;
use super::summary::{Ends, label};
use crate::measure::{Name, Verdict, Worst};
use crate::scene::Scene;

/// Every limit that a scene sets for its sheet.
pub(super) fn limits(scene: &Scene, extremes: &Extremes, ends: &Ends) -> Vec<Verdict> {
    let limits = &scene.limits;
    let target = scene.target.is_some();
    let mut out = Vec::new();
    let mut judge = |name: Name, most: Most, unit: f64, limit: Option<f64>| {
        let (Some(place), Some(limit)) = (most.0, limit) else { return };
        let worst = Worst { value: place.value / unit, at: label(&place), place: Some(place.at) };
        out.push(Verdict::of(name, worst, limit / unit, Some(place.step)));
    };
    let degree = 1_f64.to_radians();
    judge(Name::Height, ends.height, 1e-3, Some(limits.height).filter(|_| target));
    judge(
        Name::OutOfPlane,
        ends.out_of_plane,
        degree,
        Some(limits.out_of_plane).filter(|_| target),
    );
    judge(Name::FibreAngle, ends.fibre_angle, degree, Some(limits.fibre_angle));
    judge(Name::Position, ends.position, 1e-3, Some(limits.position));
    judge(Name::Strain, extremes.strain, 1.0, Some(limits.strain));
    judge(Name::Shear, extremes.shear, degree, Some(limits.shear));
    judge(Name::GripperForce, extremes.force, 1.0, limits.gripper_force);
    let pad = &scene.settings.pad;
    let safe = |force: Option<f64>| force.map(|force| force / limits.grip_safety);
    judge(Name::Slip, extremes.along, 1.0, safe(pad.slip_force));
    judge(Name::Holding, extremes.across, 1.0, safe(pad.holding_force));
    judge(Name::Tilt, extremes.tilt, degree, Some(limits.tilt));
    judge(Name::Penetration, extremes.depth, 1e-3, Some(limits.penetration));
    out
}
