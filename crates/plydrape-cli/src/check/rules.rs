//! Rules of the model, limits and the planner, as text.

use super::Line;
use crate::numbers::{degrees, millimetres, short};
use plydrape::measure::angle_of_slack;
use plydrape::scene::{
    ContactEnd, Limits, Model, PlanMethod, Release, ReleaseOrder, Scene, SlopeRule, Stepping,
};

/// Rules of the model, contact and limits.
pub(super) fn rules(scene: &Scene) -> [Line; 7] {
    let settings = &scene.settings;
    let limits = &scene.limits;
    let model = match settings.model {
        Model::Sheet => "sheet",
        Model::Catenaries => "catenaries",
    };
    let slopes = match settings.slopes {
        SlopeRule::MinForce => "min-force",
        SlopeRule::MomentBalance => "moment-balance",
    };
    let stepping = match settings.contact.stepping {
        Stepping::Once => "looked for once per step",
        Stepping::Cut => "steps cut where they dip deeper",
    };
    let end = match settings.contact.end {
        ContactEnd::Free => "free slope at its ends",
        ContactEnd::Tangent => "mold's slope at its ends",
    };
    let force =
        |limit: Option<f64>| limit.map_or("any".into(), |force| format!("{} N", short(force)));
    [
        (
            "model",
            format!(
                "{model}; {slopes} slopes, EA {} N, g {} m/s², gripper tilt up to {} deg",
                short(settings.axial_stiffness),
                short(settings.gravity),
                degrees(settings.max_tilt)
            ),
        ),
        (
            "contact",
            format!("within {} mm, {stepping}, {end}", millimetres(settings.contact.tolerance)),
        ),
        (
            "limits",
            format!(
                "{}, bridging {} mm, overstretch {} %, strain {} %, force {}",
                slack(scene),
                millimetres(limits.bridging),
                short(limits.overstretch * 100.0),
                short(limits.strain * 100.0),
                force(limits.force),
            ),
        ),
        (
            "",
            format!(
                "shear {} deg, {} deg after landing; penetration {} mm",
                degrees(limits.shear),
                degrees(limits.landing_shear),
                millimetres(limits.penetration),
            ),
        ),
        (
            "",
            format!(
                "landing within {} mm (contact), {} mm (grippers), fibers within {} deg, {} % in contact",
                millimetres(limits.landing_contact),
                millimetres(limits.landing_gripper),
                degrees(limits.fibre_angle),
                short(limits.contact_share * 100.0)
            ),
        ),
        (
            "",
            format!(
                "each gripper: tilt {} deg, {} deg/s; load {}, pull {}",
                degrees(limits.tilt),
                degrees(limits.tilt_rate),
                force(Some(limits.gripper_load)),
                force(limits.gripper_pull),
            ),
        ),
        ("", reach(limits)),
    ]
}

/// The limits of slack in all units, and the preset that limits come from.
fn slack(scene: &Scene) -> String {
    let limits = &scene.limits;
    let angle = limits.slack_angle.unwrap_or(angle_of_slack(limits.slack_ratio));
    let preset = limits.preset.map(|preset| format!("preset {}; ", preset.name()));
    let wrinkle = limits.wrinkle.map(|height| format!(", {} mm high", millimetres(height)));
    format!(
        "{}slack {} % (as fiber angle {} deg{})",
        preset.unwrap_or_default(),
        short(limits.slack_ratio * 100.0),
        rounded(angle),
        wrinkle.unwrap_or_default(),
    )
}

/// An angle in degrees, with two digits after the point at most.
fn rounded(angle: f64) -> String {
    short((angle.to_degrees() * 100.0).round() / 100.0)
}

/// Where grippers may be and how fast they may move.
fn reach(limits: &Limits) -> String {
    let workspace = match limits.workspace {
        Some(sides) => {
            let [x, y, z] = sides.map(|ends| ends.map(millimetres).join(" to "));
            format!("x {x}, y {y}, z {z} mm")
        }
        None => "anywhere".into(),
    };
    format!(
        "grippers {workspace}, {} mm apart, up to {} m/s, {} m/s², {} m/s³{}",
        millimetres(limits.gripper_distance),
        short(limits.speed),
        short(limits.acceleration),
        short(limits.jerk),
        limits
            .duration
            .map_or(String::new(), |longest| format!("; done within {} s", short(longest)))
    )
}

/// How a motion would be planned; nothing where there is nothing to plan.
pub(super) fn plan(scene: &Scene) -> Option<Line> {
    let (Some(_), Some(_), plan) = (&scene.mold, &scene.target, &scene.plan) else {
        return None;
    };
    let method = match plan.method {
        PlanMethod::Path => "path",
        PlanMethod::Stepwise => "stepwise",
    };
    let far = plan.move_limit.map(|far| format!(" of up to {} mm", millimetres(far)));
    let text = format!(
        "{method}, {} steps{}, up to {} drapes, seed {}, motion at {} Hz",
        plan.steps,
        far.unwrap_or_default(),
        plan.evaluations,
        plan.seed,
        short(plan.rate)
    );
    Some(("plan", text))
}

/// When pads let go, if they do not hold the ply to the end.
pub(super) fn release(scene: &Scene) -> Option<Line> {
    let Release { order, dwell, .. } = scene.release.as_ref()?;
    let presses = *dwell > 0.0;
    let dwell = short(*dwell);
    let when = match (order, presses) {
        (ReleaseOrder::End, false) => "all pads let go as the motion ends".into(),
        (ReleaseOrder::End, true) => {
            format!("all pads press for {dwell} s after the motion and then let go")
        }
        (ReleaseOrder::Landed, false) => {
            "each pad lets go as soon as the ply around it lies, the others as the motion ends"
                .into()
        }
        (ReleaseOrder::Landed, true) => format!(
            "each pad lets go when the ply around it has lain for {dwell} s; the others press for {dwell} s after the motion"
        ),
    };
    Some(("release", format!("{when}; the verdict is that of the ply without pads")))
}

/// What carries the grippers, if they do not move by themselves.
pub(super) fn tool(scene: &Scene) -> Vec<Line> {
    let Some(tool) = &scene.tool else { return Vec::new() };
    let axis = |axis: &plydrape::tool::Axis| {
        let [least, most] = axis.stroke.map(millimetres);
        format!("{} {least} to {most} mm", axis.name)
    };
    let axes: Vec<String> = tool.axes.iter().map(axis).collect();
    let axes = if axes.is_empty() { "no axes".into() } else { format!("axes {}", axes.join(", ")) };
    let [rate, acceleration] = [tool.turn_rate, tool.turn_acceleration].map(degrees);
    let joints = if scene.tilts() { "" } else { ", pads without joints" };
    let residual = tool.residual.map_or(String::new(), |most| {
        format!("; brings grippers to within {} mm", millimetres(most))
    });
    let place = |pose: &plydrape::mold::Pose, axis: usize| {
        let [x, y, z] = pose.position.map(millimetres);
        // 0.0 takes the sign off a zero
        let [a, b, c] = pose.axes[axis].map(|c| short((c * 1e4).round() / 1e4 + 0.0));
        format!("({x}, {y}, {z}) mm, its {} along ({a}, {b}, {c})", ["x", "y", "z"][axis])
    };
    let turns = format!("turns by {rate} deg/s, {acceleration} deg/s²{residual}");
    vec![
        ("tool", format!("one frame, {axes}{joints}; {turns}")),
        ("", format!("flange in the frame at {}", place(&tool.flange, 2))),
        ("", format!("scene in the robot's world at {}", place(&tool.world, 0))),
    ]
}
