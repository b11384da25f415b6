//! Grippers that a robot carries: what it cannot follow is not done, in both models, with errors or without.

use crate::common::{drape_sheet, parse};
use plydrape::layup::Layup;
use plydrape::measure::Name;
use plydrape::scene::Scene;
use plydrape_io::result::ResultFile;
use plydrape_io::result::read;
use plydrape_io::robot::program::Program;
use plydrape_io::text::table::verdict_in_a_line;
use std::path::Path;

/// 2 × 2 grippers, 98 mm apart, of which one row comes 18 mm nearer to the other and 30 mm lower.
fn closing(tool: &str) -> Scene {
    parse(&text(tool))
}

fn text(tool: &str) -> String {
    format!(
        "[model]\nkind = \"sheet\"\n[sheet]\nmesh = \"25 mm\"\n[ply]\ngrippers = [2, 2]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"krogh2018\"\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.2\n[target]\npositions = [[[0, 0, 0.2], [0.08, 0, 0.17]], [[0, 0.098, 0.2], [0.08, 0.098, 0.17]]]\n[motion]\nkind = \"straight\"\nsteps = 10\n[limits]\ntilt = \"89 deg\"\n{tool}\n"
    )
}

/// The scene with pads that have a size.
fn padded(tool: &str) -> Scene {
    let text = text(tool).replace("height = 0.2", "height = 0.2\npad_radius = 0.01");
    parse(&text.replace("[ply]", "[ply]\noverhang = 0.01"))
}

fn along_z() -> Scene {
    closing("[tool]\nresidual = \"1 mm\"\naxes = [{ direction = \"z\", stroke = [-0.1, 0.1] }]")
}

fn draped(scene: &Scene) -> ResultFile {
    crate::common::drape(scene)
}

fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>().sqrt()
}

/// Axes along z leave grippers as far apart in the frame as they were: the frame turns and is lower in its middle, each row stays
/// beside where it should be, and the limit of the residual says so. With axes along x too nothing is left.
#[test]
fn what_the_axes_cannot_follow_is_not_done() {
    let result = draped(&along_z());
    let places: Vec<[f64; 3]> = result.steps[9].grippers.iter().map(|g| g.position).collect();
    let width = apart(places[0], places[1]);
    assert!(width > 0.0979, "{width}");
    let record = result.summary.tool.clone().expect("a tool");
    let asked = [[0.0, 0.0, 0.2], [0.08, 0.0, 0.17]];
    let off = apart(places[0], asked[0]);
    assert!((record.residual_mm - 1e3 * off).abs() < 1e-6 && off > 5e-3, "{record:?} {off}");
    let verdict = result.summary.limits.iter().find(|v| v.name == Name::ToolResidual).unwrap();
    assert!(!verdict.ok && !result.summary.accepted() && verdict.step == Some(10), "{verdict:?}");

    // the cause leads the verdict, with what the plan would need
    let short = closing(
        "[tool]\nresidual = \"1 mm\"\naxes = [{ direction = \"z\", stroke = [-0.1, 0.1] }, { direction = \"x\", stroke = [-0.002, 0.002] }]",
    );
    let result = draped(&short);
    let verdict = verdict_in_a_line(&result, &result.summary);
    assert!(verdict.contains(": x of g"), "{verdict}");
    // both grippers miss as much
    assert!(verdict.contains("2 mm in step 10; tool residual 4.28 mm"), "{verdict}");

    let both = closing(
        "[tool]\nresidual = \"1 mm\"\naxes = [{ direction = \"z\", stroke = [-0.1, 0.1] }, { direction = \"x\", stroke = [-0.02, 0.02] }]",
    );
    let result = draped(&both);
    assert!(result.summary.tool.as_ref().unwrap().residual_mm < 1e-6);
    for (gripper, asked) in result.steps[9].grippers.iter().zip(asked) {
        assert!(apart(gripper.position, asked) < 1e-9);
    }
}

/// The sheet hangs from the same places as the catenaries, and a pad tilts from the stem that the frame turns.
#[test]
fn both_models_hang_from_where_the_tool_brings_the_grippers() {
    let scene = along_z();
    let result = draped(&scene);
    let drape = drape_sheet(&scene).sheet.unwrap().drape;
    let tool = scene.layup.tool.as_ref().unwrap();
    let places: Vec<[f64; 3]> = result.steps[9].grippers.iter().map(|g| g.position).collect();
    let stem = tool.direction(&places);
    assert!(stem[2] < 0.96, "{stem:?}");
    for (pad, gripper) in drape.last.pads.iter().zip(&result.steps[9].grippers) {
        assert!(apart(pad.target, gripper.position) < 1e-12);
        assert!(apart(pad.stem, stem) < 1e-8);
        let normal = gripper.normal();
        let tilt = (0..3).map(|c| normal[c] * stem[c]).sum::<f64>().acos().to_degrees();
        assert!((tilt - gripper.tilt_deg).abs() < 1e-5, "{tilt} {}", gripper.tilt_deg);
    }
}

/// Errors are of grippers that the tool has brought somewhere, not of what it was asked for: it does not take them back.
#[test]
fn errors_come_after_the_tool() {
    let errors = "[errors]\ngripper = { position = { deviation = \"1 mm\" } }";
    let scene = along_z();
    let with = closing(errors);
    let draw = with.errors.unwrap().draw(3, 4);
    let carried = scene.layup.carried().0.into_owned();
    let real = draw.apply(&scene.layup);
    assert_eq!(real.motion, draw.apply(&Layup { tool: None, ..carried }).motion);
    // the tool is still there, for the direction of its stems, and leaves the errors as they are
    let (made, record) = real.carried();
    assert_eq!(
        (made.motion.clone(), record.expect("a tool").residual_mm),
        (real.motion.clone(), 0.0)
    );
}

/// Pads without joints turn with the frame: results and programs have its orientation and no tilt of the pads, and the tilt of a step is
/// how far the lines of the ply are from it. The frame turns as it does with ball joints.
#[test]
fn pads_without_joints_are_turned_as_the_frame() {
    let axes = "[tool]\naxes = [{ direction = \"z\", stroke = [-0.1, 0.1] }]";
    let ball = draped(&padded(axes));
    let scene = padded(&format!("{axes}\njoints = \"none\""));
    assert!(!scene.layup.tilts());
    let result = draped(&scene);
    let program = Program::new(&result).unwrap();
    for (k, (step, with_joints)) in result.steps.iter().zip(&ball.steps).enumerate() {
        let frame = program.flange.as_ref().unwrap()[k];
        for (n, gripper) in step.grippers.iter().enumerate() {
            assert_eq!(
                (gripper.tilt_deg, gripper.position),
                (0.0, with_joints.grippers[n].position)
            );
            assert!(apart(gripper.normal(), frame.axes[2]) < 1e-9);
            assert_eq!(program.pads[n].tilts[k], 0.0);
            let pad = &program.pads[n].poses[k];
            assert!((0..3).all(|axis| apart(pad.axes[axis], frame.axes[axis]) < 1e-9), "{pad:?}");
        }
        let [lines, tilts] =
            [step, with_joints].map(|step| step.measures.value(Name::Tilt).unwrap());
        let most = with_joints.grippers.iter().map(|gripper| gripper.tilt_deg).fold(0.0, f64::max);
        assert!((lines - tilts).abs() < 1e-9 && (tilts - most).abs() < 1e-9, "{lines} {tilts}");
    }
    let verdicts = |result: &ResultFile| {
        result.summary.limits.iter().map(|verdict| verdict.name).collect::<Vec<_>>()
    };
    assert!(
        verdicts(&ball).contains(&Name::TiltRate) && !verdicts(&result).contains(&Name::TiltRate)
    );
    let back = read::parse(result.text().unwrap().as_bytes(), Path::new("result.json")).unwrap();
    assert_eq!(back.scene.tool, result.scene.tool);
}

/// A result keeps its tool and what the motion takes of it; one whose tool carries other grippers is refused.
#[test]
fn a_result_keeps_its_tool() {
    let result = draped(&Scene { title: "tool".into(), ..along_z() });
    let text = result.text().unwrap();
    let back = read::parse(text.as_bytes(), Path::new("result.json")).unwrap();
    assert_eq!(back.scene.tool, result.scene.tool);
    assert_eq!(back.summary.tool, result.summary.tool);
    let mut other = result.clone();
    other.scene.tool.as_mut().unwrap().mounts.pop();
    let fault = read::parse(other.text().unwrap().as_bytes(), Path::new("result.json"))
        .unwrap_err()
        .to_string();
    assert!(fault.contains("its tool carries 3 grippers, not 4"), "{fault}");
}

/// The flange of a program, the place of the tool in it and the strokes bring each pad to where the motion has it; the mold stands
/// in the world where the scene says.
#[test]
fn flange_and_strokes_of_a_program_bring_the_pads_to_their_places() {
    let scene = closing(
        "[tool]\naxes = [{ direction = \"z\", stroke = [-0.1, 0.1] }]\nflange = { position = [0, 0, 0.2], rotation = [\"180 deg\", 0, 0.3] }\nworld = { position = [1, 0, 0.5] }",
    );
    let result = draped(&scene);
    let program = Program::new(&result).unwrap();
    assert_eq!(program.frames.mold.position, [1.0, 0.0, 0.5]);
    let names: Vec<&str> = program.axes.iter().map(|axis| axis.name.as_str()).collect();
    assert_eq!(names, ["g0_0_z", "g1_0_z", "g0_1_z", "g1_1_z"]);
    let (flange, mounts) =
        (program.flange.as_ref().unwrap(), &scene.layup.tool.as_ref().unwrap().mounts);
    // passive joints, apart from what the tool does
    let tilts = result.steps.iter().map(|step| step.grippers.iter().map(|g| g.tilt_deg));
    for (k, step) in tilts.enumerate() {
        for (pad, tilt_deg) in program.pads.iter().zip(step) {
            assert!((pad.tilts[k].to_degrees() - tilt_deg).abs() < 1e-6, "{} {k}", pad.name);
        }
    }
    assert!(program.pads.iter().any(|pad| pad.tilts.iter().any(|tilt| *tilt > 0.01)));
    for k in 0..program.times.len() {
        // the flange looks down
        assert!(flange[k].axes[2][2] < -0.9);
        let frame = flange[k].compose(&program.frames.tool);
        for (n, pad) in program.pads.iter().enumerate() {
            let [x, y, z] = mounts[n];
            let place = frame.place([x, y, z + program.axes[n].values[k]]);
            assert!(apart(place, pad.poses[k].position) < 1e-8, "step {k}, {}", pad.name);
        }
    }
}
