//! Limits that no plan that ends at the target can keep, found before any search.
//!
//! Start, target and ideal drape are compared with the limits of the scene. Neighbors that are further apart at the
//! start than the ply between them is long, and a start inside the mold, are not checked here, because reading the
//! scene refuses them.

use crate::clearance::{self, Poses};
use crate::geometry::rotation::{oriented, x_axis};
use crate::geometry::vector::angle_between;
use crate::layup::Target;
use crate::measure::{Name, Verdict, Worst};
use crate::measure::{closest_grippers, outside_workspace};
use crate::mold::{Mold, distance};
use crate::net::Missing;
use crate::planner::spring_back::spring_back;
use crate::ply::{LineCell, orientations, shear};
use crate::scene::Scene;
use crate::state::Site;

/// A value and a text that says where it is.
type Found = (f64, String);

/// Every limit that the scene itself rules out, with value and place; empty if a plan may keep them all.
///
/// The verdicts are those of [`crate::outcome::Summary::limits`] by name and unit, all of them not
/// ok. Three have no limit in the scene: `missing_nodes` of the ideal drape, `off_mold` of
/// targets that the scene gives by position (mm), and `move_limit`, the reach of a gripper in all steps (mm).
#[must_use]
pub fn infeasible_limits(scene: &Scene) -> Vec<Verdict> {
    let start = scene.layup.start();
    let mut out = Vec::new();
    out.extend(places(scene, start, "at the start", Some(1)));
    out.extend(clearance_at_start(scene, start));
    let Some(target) = &scene.layup.target else {
        return out;
    };
    out.extend(places(scene, &target.grippers, "at the target", None));
    out.extend(overstretch(scene, target));
    out.extend(shear(scene, target));
    out.extend(missing_nodes(scene, target));
    if let Some(mold) = &scene.layup.mold {
        out.extend(off_mold(scene, target, mold));
        out.extend(tilt(scene, target, mold));
        out.extend(clearance_at_target(scene, target, mold));
    }
    out.extend(reach(scene, start, target));
    out
}

/// As [`infeasible_limits`], and the ply that springs back or slides whatever the motion: the nominal one, or too many of the sample that is
/// to judge the plan if it is `sampled`; that takes some drapes, and `stop` may end it.
#[must_use]
pub fn with_spring_back(
    scene: &Scene,
    sampled: bool,
    stop: &(dyn Fn() -> bool + Sync),
) -> Vec<Verdict> {
    let mut limits = infeasible_limits(scene);
    if limits.is_empty() {
        limits.extend(spring_back(scene, sampled, stop));
    }
    limits
}

/// A verdict (in the measure's unit) of something that exceeds its limit, if it does.
fn beyond(name: Name, limit: f64, found: Option<Found>) -> Option<Verdict> {
    let (value, at) = found?;
    let verdict = Verdict::new(name, Worst { value, at, place: None }, limit, None);
    (!verdict.ok).then_some(verdict)
}

/// The largest value, the first of several that are equal.
fn largest(values: impl Iterator<Item = (f64, usize)>) -> Option<(f64, usize)> {
    values.reduce(|most, next| if next.0 > most.0 { next } else { most })
}

/// Grippers outside the workspace or too close to each other.
fn places(
    scene: &Scene,
    positions: &[[f64; 3]],
    when: &'static str,
    step: Option<usize>,
) -> impl Iterator<Item = Verdict> {
    let limits = &scene.limits;
    let workspace = limits
        .workspace
        .and_then(|workspace| outside_workspace(positions, workspace, scene.layup.ply.cell));
    let found = [
        (Name::Workspace, 0.0, workspace),
        (
            Name::GripperDistance,
            limits.least(Name::GripperDistance) * 1e3,
            closest_grippers(positions),
        ),
    ];
    found.into_iter().filter_map(move |(name, limit, found)| {
        let worst = Worst::new(&found?, &scene.layup);
        let worst = Worst { at: format!("{} {when}", worst.at), ..worst };
        Some(Verdict::new(name, worst, limit, step)).filter(|verdict| !verdict.ok)
    })
}

/// Fabric between two targets (m): along the mold if both lie on it.
fn fabric(scene: &Scene, a: [f64; 3], b: [f64; 3]) -> f64 {
    let tolerance = scene.layup.settings.contact.tolerance;
    let lies = |mold: &&Mold| [a, b].iter().all(|p| mold.signed_distance(*p).abs() <= tolerance);
    match scene.layup.mold.as_ref().filter(lies) {
        Some(mold) => mold.path_length(a, b),
        None => distance(a, b),
    }
}

/// Neighbors whose targets are further apart than the ply between them is long; targets of the net never are.
fn overstretch(scene: &Scene, target: &Target) -> Option<Verdict> {
    if target.drape.is_some() {
        return None;
    }
    let lines = scene.layup.ply.lines();
    let share = |n: usize| {
        let [a, b] = lines.ends(n).map(|gripper| target.grippers[gripper]);
        fabric(scene, a, b) / lines.flat_length(n, scene.layup.ply.length_factor) - 1.0
    };
    let worst = largest((0..lines.edges()).map(|n| (share(n), n)));
    let found = worst.map(|(share, n)| {
        (share, format!("{} at the target", Site::Catenary(n).label(&scene.layup)))
    });
    beyond(Name::Overstretch, scene.limits.most(Name::Overstretch), found)
}

/// Shear of the ideal drape, or of the cells between the targets where it is not known.
fn shear(scene: &Scene, target: &Target) -> Option<Verdict> {
    let (lines, ply) = (scene.layup.ply.lines(), &scene.layup.ply);
    let found = match &target.drape {
        Some(net) => net.report.largest_shear.map(|(angle, [i, j])| {
            let [x, y, z] = net.node([i, j]).unwrap_or_default().map(|c| c * 1e3);
            (
                angle,
                format!("net cell [{i},{j}] of the ideal drape, at ({x:.1}, {y:.1}, {z:.1}) mm"),
            )
        }),
        // without a net, the shear of a cell follows from the length of its diagonals over the mold
        None => {
            let path = |n: usize| {
                let [a, b] = lines.ends(n).map(|gripper| target.grippers[gripper]);
                fabric(scene, a, b)
            };
            let angle = |cell: &LineCell| {
                let paths =
                    cell.bias.map(|bias| shear::mean_path(bias.list().iter().map(|n| path(*n))));
                let flat = lines.flat_length(cell.bias[0].list()[0], ply.length_factor);
                shear::angle(cell.trellis, paths[0].max(paths[1]).max(flat))
            };
            let worst = largest(lines.cells().iter().enumerate().map(|(n, cell)| (angle(cell), n)));
            worst.map(|(angle, cell)| {
                let [i, j] = lines.cells()[cell].id;
                (angle, format!("cell [{i},{j}] of the target"))
            })
        }
    };
    let found = found.map(|(angle, at)| (angle.to_degrees(), at));
    beyond(Name::Shear, scene.limits.most(Name::Shear).to_degrees(), found)
}

/// Parts of the ideal drape without a place on the mold.
fn missing_nodes(scene: &Scene, target: &Target) -> Option<Verdict> {
    let net = target.drape.as_ref()?;
    let [low, high] = scene.layup.ply.held_bounds();
    let outline = scene.layup.ply.cut.as_ref().map(|cut| &cut.outline);
    // what is beyond the grippers may hang beside the mold
    let between_grippers = |missing: &&Missing| {
        let uv = net.placement.fabric(missing.node);
        let held = (0..2).all(|n| {
            let rounding = 1e-9 * net.placement.mesh[n];
            (low[n] - rounding..=high[n] + rounding).contains(&uv[n])
        });
        held && outline.is_none_or(|outline| outline.contains(uv))
    };
    let missing: Vec<&Missing> = net.missing.iter().filter(between_grippers).collect();
    let first = missing.first()?;
    let found = (missing.len() as f64, format!("ideal drape: {first}"));
    beyond(Name::MissingNodes, 0.0, Some(found))
}

/// Targets beyond the mold's border, or deeper in the mold than the contact tolerance; targets of the net lie on it.
fn off_mold(scene: &Scene, target: &Target, mold: &Mold) -> Option<Verdict> {
    if target.drape.is_some() {
        return None;
    }
    let off = |place: [f64; 3]| {
        let closest = mold.closest_point(place);
        if closest.beyond { closest.distance } else { -closest.distance }
    };
    let worst = largest(target.grippers.iter().enumerate().map(|(n, place)| (off(*place), n)));
    let found = worst.map(|(far, n)| {
        let side = if mold.closest_point(target.grippers[n]).beyond {
            "beyond its boundary"
        } else {
            "inside it"
        };
        (far * 1e3, format!("target of {}, {side}", Site::Gripper(n).label(&scene.layup)))
    });
    beyond(Name::OffMold, scene.layup.settings.contact.tolerance * 1e3, found)
}

/// The mold's slope where a gripper is to stand on it: the gripper turns with the ply, and the ply follows the mold.
fn tilt(scene: &Scene, target: &Target, mold: &Mold) -> Option<Verdict> {
    let tolerance = scene.layup.settings.contact.tolerance;
    let stem = scene.layup.stems(&target.grippers);
    let tilt = |place: [f64; 3]| {
        let closest = mold.closest_point(place);
        let stands = !closest.beyond && closest.distance.abs() <= tolerance;
        stands.then(|| angle_between(closest.normal, stem))
    };
    let all = target.grippers.iter().enumerate();
    let found = largest(all.filter_map(|(n, place)| Some((tilt(*place)?, n)))).map(|(tilt, n)| {
        (
            tilt.to_degrees(),
            format!("mold at the target of {}", Site::Gripper(n).label(&scene.layup)),
        )
    });
    beyond(Name::Tilt, scene.limits.most(Name::Tilt).to_degrees(), found)
}

/// Bodies too near to each other, to an obstacle or to the mold where all grippers stand on the mold: their pads have its normal.
fn clearance_at_target(scene: &Scene, target: &Target, mold: &Mold) -> Option<Verdict> {
    if scene.layup.bodies.is_empty() {
        return None;
    }
    let neighbors = scene.layup.ply.neighbors();
    let own = orientations(&scene.layup.ply, &neighbors, &target.grippers);
    let fixed = scene.layup.fixed_pads(&target.grippers);
    let tolerance = scene.layup.settings.contact.tolerance;
    let stands = |(place, own): (&[f64; 3], [f64; 4])| {
        let closest = mold.closest_point(*place);
        let on_mold = !closest.beyond && closest.distance.abs() <= tolerance;
        on_mold.then(|| fixed.unwrap_or_else(|| oriented(closest.normal, x_axis(own))))
    };
    let turned: Option<Vec<[f64; 4]>> = target.grippers.iter().zip(own).map(stands).collect();
    let poses = Poses::new(&scene.layup, &target.grippers, &turned?, &target.grippers);
    too_near(scene, &poses, "at the target", None)
}

/// Bodies that are too close at the start to what stands in the cell, or to each other.
fn clearance_at_start(scene: &Scene, start: &[[f64; 3]]) -> Option<Verdict> {
    let layup = &scene.layup;
    if layup.bodies.is_empty() || start.is_empty() {
        return None;
    }
    let poses = Poses::by_neighbors(layup, &layup.ply.neighbors(), start);
    too_near(scene, &poses, "at the start", Some(1))
}

/// Bodies too near to each other, to an obstacle or to the mold where they are.
fn too_near(scene: &Scene, poses: &Poses, when: &str, step: Option<usize>) -> Option<Verdict> {
    let least = scene.limits.least(Name::Clearance);
    let nearest = clearance::at_poses(&scene.layup, least, poses)?;
    let at = format!("{} {when}", nearest.label(&scene.layup));
    let worst = Worst { value: nearest.distance * 1e3, at, place: Some(nearest.place) };
    let verdict = Verdict::new(Name::Clearance, worst, least * 1e3, step);
    (!verdict.ok).then_some(verdict)
}

/// A distance to the target that is longer than the moves of all steps together.
fn reach(scene: &Scene, start: &[[f64; 3]], target: &Target) -> Option<Verdict> {
    let plan = &scene.plan;
    let moves = plan.steps.saturating_sub(1);
    let reach = plan.move_limit? * moves as f64;
    let distances = start.iter().zip(&target.grippers).map(|(a, b)| distance(*a, *b));
    let found = largest(distances.enumerate().map(|(n, far)| (far, n))).map(|(far, n)| {
        (
            far * 1e3,
            format!("straight way of {} in {moves} moves", Site::Gripper(n).label(&scene.layup)),
        )
    });
    beyond(Name::MoveLimit, reach * 1e3, found)
}
