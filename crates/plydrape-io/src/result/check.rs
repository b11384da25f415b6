//! What is impossible in a result that was read.

use super::{Also, ResultFile, SceneEcho};
use crate::Error;
use crate::store::shown;
use plydrape::bodies::{Bodies, Shape};
use plydrape::draping::record::CatenaryState;
use plydrape::layup::{Friction, Model, PickUp, Settings};
use plydrape::material::{MomentCurve, Section, TensionLaw};
use plydrape::measure::Verdict;
use plydrape::motion::{MOST_STEPS, is_too_short};
use plydrape::outcome::{Step, Summary};
use plydrape::ply::{FARTHEST, Grid, GripperId, Ply, gripper_name, is_near};
use plydrape::sheet::Event;

/// What is impossible in a result, in words: a file whose check sum was made anew may hold anything, and everything made of
/// it relies on this.
pub(super) fn fault(result: &ResultFile) -> Option<String> {
    let also = || result.also.as_ref().and_then(|also| also_fault(result, also));
    let too_large = || match result.check_within(LARGEST_NUMBER) {
        Err(Error::NotFinite { key, value }) => {
            Some(format!("`{key}` is {value}, beyond {LARGEST_NUMBER:e}"))
        }
        _ => None,
    };
    net_fault(&result.scene)
        .or_else(|| steps_fault(&result.steps))
        .or_else(|| deciding_fault(result))
        .or_else(also)
        .or_else(|| states_fault(result))
        .or_else(too_large)
}

/// Largest number of a result in size: its square and its cube are far from overflow.
const LARGEST_NUMBER: f64 = 1e30;
/// Rounding of an arc length, as a share of it.
const ROUNDING: f64 = 1e-12;
/// Most grippers along a side, as in scenes.
const MOST_GRIPPERS: usize = 1000;
/// Most grippers that are no array along the yarns: those of a whole array.
const MOST_HELD: usize = MOST_GRIPPERS * MOST_GRIPPERS;
/// Smallest and largest size of a cell, a mesh, an overhang or a pad (m), as in scenes.
const SIZES: [f64; 2] = [1e-6, 1e4];
/// Smallest and largest length factor of a ply: an error of its length leaves a tenth at least.
const LENGTH_FACTORS: [f64; 2] = [0.1, 10.0];

/// What is impossible in the scene's ply.
pub(super) fn ply_fault(scene: &SceneEcho) -> Option<String> {
    // size of the ply: its cut, the array of grippers, cells and fabric length
    let Grid { nu, nv } = scene.ply.grid;
    if let Some(what) = cut_fault(&scene.ply) {
        return Some(what);
    }
    let held = scene.ply.cut.as_ref().is_some_and(|cut| !cut.held.is_empty());
    if !held && (!(2..=MOST_GRIPPERS).contains(&nu) || !(1..=MOST_GRIPPERS).contains(&nv)) {
        return Some(format!("there is no ply of {nu} × {nv} grippers"));
    }
    let [a, b] = scene.ply.cell;
    if ![a, b].iter().all(|side| (SIZES[0]..=SIZES[1]).contains(side)) {
        return Some(format!("there is no cell of {a} × {b} m"));
    }
    let longer = scene.ply.length_factor;
    if !(LENGTH_FACTORS[0]..=LENGTH_FACTORS[1]).contains(&longer) {
        return Some(format!("there is no fabric {longer} times as long as it should be"));
    }

    // the title is a line of plain text
    if let Some(c) = shown::control(&scene.title) {
        return Some(format!("its title holds the control character {}", c.escape_unicode()));
    }

    // the material: section, and tables of moment and tension
    let sound = match scene.ply.material.section {
        Section::Line { mass, flexural_rigidity } => mass > 0.0 && flexural_rigidity >= 0.0,
        Section::Areal { mass, warp_rigidity, weft_rigidity } => {
            mass > 0.0 && warp_rigidity >= 0.0 && weft_rigidity >= 0.0
        }
    };
    if !scene.ply.material.moment.iter().flatten().all(MomentCurve::is_sound) {
        return Some("the bending of its material is no table of moment over curvature".into());
    }
    if let Some(TensionLaw::Table { strain, force }) = &scene.ply.material.tension
        && (strain.len() != force.len() || strain.len() < 2 || !strain.is_sorted_by(|a, b| a < b))
    {
        return Some("the tension of its material is no table of force over strain".into());
    }

    if let Some(what) = bodies_fault(&scene.bodies) {
        return Some(what);
    }

    // settings of the models
    let Settings { axial_stiffness, gravity, max_tilt, sheet, pad, contact, .. } = scene.settings;
    let friction = match contact.friction {
        Friction::Coulomb(coefficient) => coefficient,
        Friction::Stick | Friction::StickForEver => 0.0,
    };
    let lip_radius = pad.lip.map_or(0.0, |lip| lip.radius);
    let lengths = [sheet.mesh.unwrap_or(0.0), sheet.overhang, pad.radius];
    if lengths.iter().chain(&[friction, contact.tack]).any(|value| *value < 0.0) {
        return Some("mesh, overhang, pads, friction and tack must not be negative".into());
    }
    // the lines of a sheet are made of these
    if sheet.mesh.is_some_and(|mesh| !(SIZES[0]..=SIZES[1]).contains(&mesh))
        || sheet.overhang.max(pad.radius).max(lip_radius) > SIZES[1]
    {
        return Some("mesh, overhang and pads must have sizes that a scene may have".into());
    }
    if !(sound && axial_stiffness > 0.0 && gravity > 0.0 && contact.tolerance > 0.0) {
        return Some("mass, stiffness, gravity and contact tolerance must be above zero".into());
    }

    // mounts and pads, which may be left out but not be zero
    let mounts = [pad.lateral_stiffness, pad.axial_stiffness, pad.slip_force, pad.holding_force];
    let lip = pad.lip.map(|lip| [lip.radius, lip.rigidity]);
    if !mounts.iter().flatten().chain(lip.iter().flatten()).all(|value| *value > 0.0) {
        return Some("what mounts and pads bear must be above zero".into());
    }
    if scene.release.as_ref().is_some_and(|release| release.dwell.is_nan() || release.dwell < 0.0) {
        return Some("its pads must not press for less than no time".into());
    }

    // the pick-up and its table
    if let Some(PickUp { height, clearance, grip, vacuum_timeout, retreat, table, lift_steps }) =
        scene.pick_up
    {
        let lengths = [clearance, grip, vacuum_timeout.unwrap_or(0.0), retreat]
            .iter()
            .all(|value| (0.0..=FARTHEST).contains(value));
        if !(lengths && height.abs() <= FARTHEST && lift_steps < MOST_STEPS) {
            return Some("its pick-up has an impossible number".into());
        }
        if table.is_some_and(|n| n >= scene.bodies.obstacles().len()) {
            return Some("the table of its pick-up is not among its obstacles".into());
        }
    }

    if !(max_tilt > 0.0 && max_tilt < std::f64::consts::FRAC_PI_2) {
        return Some(format!("there is no largest tilt of {max_tilt} rad"));
    }

    // if there are targets, every gripper has one
    let target = &scene.target.as_ref()?.grippers;
    match (target.len(), scene.ply.grippers()) {
        (found, count) if found != count => {
            Some(format!("its target has {found} grippers, not {count}"))
        }
        _ => target.iter().find_map(|place| far("a target", place)),
    }
}

/// What is impossible in bodies and obstacles.
fn bodies_fault(bodies: &Bodies) -> Option<String> {
    // every body and every obstacle has a shape of some size, and a name of plain text
    let moving = bodies.bodies().iter().map(|body| (&body.name, &body.shape));
    let standing = bodies.obstacles().iter().map(|body| (&body.name, &body.shape));
    let fault = moving.chain(standing).find_map(|(name, shape)| {
        let near = |place: &[f64; 3]| is_near(place);
        let sound = match shape {
            Shape::Cylinder { radius, from, to } => *radius > 0.0 && from < to,
            Shape::Box { size, at } => size.iter().all(|side| *side > 0.0) && near(at),
            Shape::Mesh { vertices, triangles } => {
                let count = vertices.len();
                !triangles.is_empty()
                    && triangles.iter().flatten().all(|n| (*n as usize) < count)
                    && vertices.iter().all(near)
            }
        };
        let control = shown::control(name).map(|_| "a body has a name of more than plain text");
        (!sound).then_some("a body has no shape").or(control)
    });

    // the axes of an obstacle are unit vectors at right angles
    let turned = |axes: &[[f64; 3]; 3]| {
        (0..3).all(|a| {
            (0..=a).all(|b| {
                let product: f64 = (0..3).map(|n| axes[a][n] * axes[b][n]).sum();
                (product - if a == b { 1.0 } else { 0.0 }).abs() < 1e-3
            })
        })
    };
    let askew =
        bodies.obstacles().iter().any(|o| !turned(&o.pose.axes) || !is_near(&o.pose.position));
    fault.or(askew.then_some("an obstacle has no place")).map(str::to_owned)
}

/// What is impossible in how the ply is cut.
fn cut_fault(ply: &Ply) -> Option<String> {
    let cut = ply.cut.as_ref()?;
    let numbers = [cut.angle, cut.turn].into_iter().chain(cut.origin);
    if !numbers.into_iter().all(|x| x.abs() <= FARTHEST) {
        return Some("its drawing has no place".into());
    }
    if cut.held.is_empty() {
        return None;
    }
    if ply.grid != Grid::NONE || cut.held.len() > MOST_HELD {
        return Some("its grippers are both an array along the yarns and none".into());
    }
    let off = cut.held.iter().find(|held| !held.place.iter().all(|x| x.abs() <= FARTHEST));
    off.map(|held| format!("gripper {} holds no point of the ply", gripper_name(held.id)))
}

fn net_fault(scene: &SceneEcho) -> Option<String> {
    let net = scene.target.as_ref()?.drape.as_ref()?;
    let [nu, nv] = net.placement.nodes;
    let nodes = nu.checked_mul(nv).filter(|_| nu > 0 && nv > 0);
    let cells = nodes.map(|_| (nu - 1) * (nv - 1));
    let seed = (0..2).all(|n| net.placement.seed[n] < net.placement.nodes[n]);
    let missing = net.missing.iter().all(|m| m.node[0] < nu && m.node[1] < nv);
    let mesh = net.placement.mesh.iter().all(|width| (SIZES[0]..=SIZES[1]).contains(width));
    if nodes != Some(net.nodes.len())
        || cells != Some(net.shear.len())
        || !seed
        || !missing
        || !mesh
    {
        return Some(format!("its ideal drape is no net of {nu} × {nv} nodes"));
    }
    net.nodes.iter().flatten().find_map(|place| far("a node of the ideal drape", place))
}

fn steps_fault(steps: &[Step]) -> Option<String> {
    if steps.is_empty() {
        return Some("it has no step".into());
    }
    let since = |n: usize| steps[n].time - steps[n - 1].time;
    if let Some(n) = (1..steps.len()).find(|n| is_too_short(since(*n))) {
        return Some(format!("the time of step {} is not after that of the step before", n + 1));
    }
    steps.iter().zip(1..).find_map(|(step, number)| {
        if step.step != number {
            return Some(format!("step {number} has the number {}", step.step));
        }
        let mut grippers = step.grippers.iter();
        let gripper = grippers.find_map(|gripper| {
            let length = gripper.quaternion.iter().map(|q| q * q).sum::<f64>().sqrt();
            if (length - 1.0).abs() > 1e-3 {
                return Some(format!(
                    "the quaternion of gripper {} has the length {length}",
                    gripper_name(gripper.id)
                ));
            }
            far("a gripper", &gripper.position).or(far("a mount", &gripper.commanded))
        });
        let lines = step.catenaries.as_ref().map_or(&[][..], |step| &step.catenaries);
        let catenary = || lines.iter().find_map(catenary_fault);
        gripper.or_else(catenary).map(|what| format!("in step {number}, {what}"))
    })
}

fn catenary_fault(line: &CatenaryState) -> Option<String> {
    let ends = [line.from, line.to].map(gripper_name).join("–");
    let named = |what: String| Some(format!("catenary {ends} has {what}"));
    if line.length <= 0.0 {
        return named(format!("the length {}", line.length));
    }
    if let Some(span) = line.spans.iter().find(|span| span.length < 0.0) {
        return named(format!("a segment of the length {}", span.length));
    }
    let contact = line.contact.as_ref()?;
    let [from, to] = contact.ends();
    if !(0.0 <= from && from <= to && to <= line.length * (1.0 + ROUNDING)) {
        return named(format!("contact from {from} to {to} m of {} m", line.length));
    }
    contact.points.iter().find_map(|place| far("a contact", place))
}

/// What is impossible in the outcome by the model that decides.
fn deciding_fault(result: &ResultFile) -> Option<String> {
    let decides = result.scene.settings.model;
    if result.summary.model != decides {
        return Some("its outcome is not of the model that decides".into());
    }
    summary_fault(&result.scene.ply, &result.summary, &result.steps)
        .or_else(|| super::check_limits::fault(result))
        .or_else(|| super::check_errors::fault(result))
        .or_else(|| super::check_tool::fault(result))
}

/// What is impossible in the drape by the other model.
fn also_fault(result: &ResultFile, also: &Also) -> Option<String> {
    let fault = match () {
        () if also.summary.model != result.summary.model.other() => {
            Some("is of the model that decides".into())
        }
        () => steps_fault(&also.steps)
            .or_else(|| summary_fault(&result.scene.ply, &also.summary, &also.steps)),
    };
    fault.map(|what| format!("the drape beside: {what}"))
}

/// What is impossible in an outcome with steps of a ply.
fn summary_fault(ply: &Ply, summary: &Summary, recorded: &[Step]) -> Option<String> {
    let steps = recorded.len();
    if summary.steps != steps || summary.steps_planned < steps {
        return Some(format!(
            "its summary has {} of {} steps",
            summary.steps, summary.steps_planned
        ));
    }
    let report = summary.catenaries.as_ref();
    let shear = report.map(|report| [report.first_shear_step, report.all_shear_step]);
    let named = shear.into_iter().flatten().chain([summary.first_contact_step()]);
    let judged = summary.limits.iter().map(|verdict| verdict.step);
    if let Some(step) = named.chain(judged).flatten().find(|n| !(1..=steps).contains(n)) {
        return Some(format!("its summary names step {step} of {steps}"));
    }
    let twice = |(n, verdict): (usize, &Verdict)| {
        summary.limits[..n].iter().any(|other| other.name == verdict.name)
    };
    if summary.limits.iter().enumerate().any(twice) {
        return Some("it judges a limit twice".into());
    }
    report_fault(summary).or_else(|| events_fault(ply, &summary.events)).or_else(|| {
        let known = |id: GripperId| ply.index(id).is_some();
        let mut first = report?.first_contact.iter();
        let unknown = first.find(|line| !(known(line.from) && known(line.to)))?;
        let ends = [unknown.from, unknown.to].map(gripper_name).join("–");
        Some(format!("its summary names a catenary {ends}"))
    })
}

/// What is impossible in what a model says beside its measures.
fn report_fault(summary: &Summary) -> Option<String> {
    match (summary.model, &summary.sheet, &summary.catenaries) {
        (Model::Sheet, Some(sheet), None) => {
            (sheet.nodes == 0).then(|| "its sheet has no node".into())
        }
        (Model::Catenaries, None, Some(_)) => None,
        _ => Some("its summary has the report of another model".into()),
    }
}

/// What is impossible in the events of pads.
fn events_fault(ply: &Ply, events: &[Event]) -> Option<String> {
    let times = || events.iter().map(|event| event.time);
    if !times().is_sorted() || times().next().is_some_and(|first| first < 0.0) {
        return Some("the events of its pads are not in the order of time".into());
    }
    let mut pads = events.iter().flat_map(|event| &event.grippers);
    let id = pads.find(|id| ply.index(**id).is_none())?;
    Some(format!("an event of its pads names gripper {id:?}"))
}

/// What is impossible in the states of a sheet: they are there where one was draped.
fn states_fault(result: &ResultFile) -> Option<String> {
    match (result.summary_of(Model::Sheet), &result.sheet_states) {
        (Some(_), None) => Some("its sheet has no states".into()),
        (None, Some(_)) => Some("the states of its sheet have no outcome".into()),
        _ => None,
    }
}

/// What is wrong with a place (m) out of all range.
fn far(what: &str, place: &[f64; 3]) -> Option<String> {
    (!is_near(place)).then(|| format!("{what} is at {place:?} m, beyond {FARTHEST:e} m"))
}
