//! Rules of the models, contact, release, tool and planner, as text.

use super::SummaryLine;
use crate::numbers::{degrees, millimeters, short};
use plydrape::geometry::Pose;
use plydrape::layup::{ContactEnd, Model, PickUp, Release, ReleaseOrder, SlopeRule, Stepping};
use plydrape::planner::path::most_candidates;
use plydrape::scene::{PlanMethod, Scene};

/// Rules of the models, and of contact.
pub(super) fn rules(scene: &Scene) -> [SummaryLine; 2] {
    let settings = &scene.layup.settings;
    // the model that decides, and the other one if it is draped too
    let called = |model: Model| match model {
        Model::Sheet => "sheet",
        Model::Catenaries => "catenaries",
    };
    let model = called(settings.model);
    let beside = match scene.also {
        true => format!(", {} beside", called(settings.model.other())),
        false => String::new(),
    };

    // the rule for the slopes of catenaries at grippers
    let slopes = match settings.slopes {
        SlopeRule::MinForce => "min-force",
        SlopeRule::MomentBalance => "moment-balance",
    };

    // how contact with the mold is found, and what slope the ply has where it leaves the mold
    let stepping = match settings.contact.stepping {
        Stepping::Once => "looked for once per step",
        Stepping::Cut => "steps cut where they penetrate deeper",
    };
    let end = match settings.contact.end {
        ContactEnd::Free => "free slope at its ends",
        ContactEnd::Tangent => "mold's slope at its ends",
    };
    [
        (
            "model",
            format!(
                "{model}{beside}; {slopes} slopes, EA {} N, g {} m/s², gripper tilt up to {} deg",
                short(settings.axial_stiffness),
                short(settings.gravity),
                degrees(settings.max_tilt)
            ),
        ),
        (
            "contact",
            format!("within {} mm, {stepping}, {end}", millimeters(settings.contact.tolerance)),
        ),
    ]
}

/// How a motion would be planned; nothing where there is nothing to plan.
pub(super) fn plan(scene: &Scene) -> Option<SummaryLine> {
    let (Some(_), Some(_), plan) = (&scene.layup.mold, &scene.layup.target, &scene.plan) else {
        return None;
    };
    let method = match plan.method {
        PlanMethod::Path => "path",
        PlanMethod::Stepwise => "stepwise",
    };
    let far = plan.move_limit.map(|far| format!(" of up to {} mm", millimeters(far)));
    let text = format!(
        "{method}, {} steps{}, up to {} drapes, seed {}, motion at {} Hz",
        plan.steps,
        far.unwrap_or_default(),
        most_candidates(scene),
        plan.seed,
        short(plan.rate)
    );
    Some(("plan", text))
}

/// How the ply is picked up, if the scene says so.
pub(super) fn pick_up(scene: &Scene) -> Option<SummaryLine> {
    let PickUp { height, clearance, grip, retreat, vacuum_timeout, .. } = scene.layup.pick_up?;
    let looks = match vacuum_timeout {
        Some(time) => format!(", programs wait {} s at most for each vacuum", short(time)),
        None => String::new(),
    };
    let text = format!(
        "from a table at {} mm: pads come from {} mm above, stand for {} s{looks}, lift the ply as they close; at the end they go back by {} mm and up by {} mm",
        millimeters(height),
        millimeters(clearance),
        short(grip),
        millimeters(retreat),
        millimeters(clearance),
    );
    Some(("pick-up", text))
}

/// When pads let go, if they do not hold the ply to the end.
pub(super) fn release(scene: &Scene) -> Option<SummaryLine> {
    let Release { order, dwell, .. } = scene.layup.release.as_ref()?;
    let presses = *dwell > 0.0;
    let dwell = short(*dwell);
    let when = match (order, presses) {
        (ReleaseOrder::End, false) => "all pads let go as the motion ends".into(),
        (ReleaseOrder::End, true) => {
            format!("all pads press for {dwell} s after the motion and then let go")
        }
        (ReleaseOrder::HollowsFirst, false) => {
            "each pad over a hollow lets go as its gripper comes to its last place, the others as the motion ends"
                .into()
        }
        (ReleaseOrder::HollowsFirst, true) => format!(
            "each pad over a hollow lets go {dwell} s after its gripper comes to its last place; the others press for {dwell} s after the motion"
        ),
    };
    Some(("release", format!("{when}; the verdict is that of the ply without pads")))
}

/// What carries the grippers, if they do not move by themselves.
pub(super) fn tool(scene: &Scene) -> Vec<SummaryLine> {
    let Some(tool) = &scene.layup.tool else { return Vec::new() };
    let axis = |axis: &plydrape::tool::Axis| {
        let [least, most] = axis.stroke.map(millimeters);
        format!("{} {least} to {most} mm", axis.name)
    };
    let axes: Vec<String> = tool.axes.iter().map(axis).collect();
    let axes = if axes.is_empty() { "no axes".into() } else { format!("axes {}", axes.join(", ")) };
    let [rate, acceleration] = [tool.turn_rate, tool.turn_acceleration].map(degrees);
    let joints = if scene.layup.tilts() { "" } else { ", pads without joints" };
    let residual = tool.residual.map_or(String::new(), |most| {
        format!("; brings grippers to within {} mm", millimeters(most))
    });
    let place = |pose: &Pose, axis: usize| {
        let [x, y, z] = pose.position.map(millimeters);
        // 0.0 takes the sign off a zero
        let [a, b, c] = pose.axes[axis].map(|c| short((c * 1e4).round() / 1e4 + 0.0));
        format!("({x}, {y}, {z}) mm, its {} along ({a}, {b}, {c})", ["x", "y", "z"][axis])
    };
    let turns = format!("turns by {rate} deg/s, {acceleration} deg/s²{residual}");
    let mut lines = vec![
        ("tool", format!("one frame, {axes}{joints}; {turns}")),
        ("", format!("flange in the frame at {}", place(&tool.flange, 2))),
        ("", format!("scene in the robot's world at {}", place(&tool.world, 0))),
    ];
    if let Some(arm) = &tool.arm {
        let reach = millimeters(arm.reach());
        let text =
            format!("{}, its chain from the shoulder to the flange {reach} mm long", arm.name);
        lines.push(("robot", text));
    }
    lines
}
