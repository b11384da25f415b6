//! The cell that a verdict is reached in, as text: mounts, loads and errors in force.

use super::SummaryLine;
use super::limits::packed;
use crate::numbers::{degrees, millimeters, short};
use plydrape::errors::{Errors, Term};
use plydrape::scene::World;
use plydrape_io::scene::SceneFile;

/// The cell by its name, what holds the ply, and what may be off.
pub(super) fn cell(scene: &SceneFile) -> Vec<SummaryLine> {
    let pad = &scene.layup.settings.pad;
    let ideal = scene.world() == World::Ideal;
    let name = scene.cell.as_deref().unwrap_or(if ideal { "ideal" } else { "of the scene" });
    let mounts = match [pad.lateral_stiffness, pad.axial_stiffness] {
        [None, None] => "rigid mounts".into(),
        both => {
            let [along, across] =
                both.map(|k| k.map_or("rigid".into(), |k| format!("{} N/mm", short(k * 1e-3))));
            format!("mounts {along} along the ply, {across} across")
        }
    };
    let force = |words: &str, force: Option<f64>| {
        force.map_or(String::new(), |force| format!(", {words} {} N", short(force)))
    };
    let (slip, hold) = (force("slip at", pad.slip_force), force("hold up to", pad.holding_force));
    let mut lines = vec![("cell", format!("{name}: {mounts}{slip}{hold}"))];
    let errors = scene.errors.filter(Errors::is_drawn);
    let errors = errors.map_or_else(|| vec!["none".into()], |errors| packed("", &terms(&errors)));
    lines.extend(std::iter::once("errors").chain(std::iter::repeat("")).zip(errors));
    lines
}

/// The terms that are not zero, and how many cells are drawn.
fn terms(errors: &Errors) -> Vec<String> {
    let Errors { frame, gripper, pick_up, material, mold, .. } = errors;
    let millimeters: fn(f64) -> String = |x| format!("{} mm", millimeters(x));
    let degrees: fn(f64) -> String = |x| format!("{}°", degrees(x));
    let percent: fn(f64) -> String = |x| format!("{} %", short(100.0 * x));
    let all = [
        ("frame", frame.position, millimeters),
        ("frame", frame.angle, degrees),
        ("each gripper", gripper.position, millimeters),
        ("strokes", gripper.stroke, percent),
        ("pick-up", pick_up.offset, millimeters),
        ("pick-up", pick_up.yaw, degrees),
        ("mass", material.areal_mass, percent),
        ("bending", material.bending, percent),
        ("shear", material.shear, percent),
        ("length", material.length, percent),
        ("mold", mold.offset, millimeters),
        ("mold", mold.tilt, degrees),
        ("waves", mold.waviness, millimeters),
    ];
    let texts =
        all.iter().filter(|(_, term, _)| !term.is_zero()).map(|(name, term, text)| match term {
            Term::Deviation(value) => format!("{name} {}", text(*value)),
            Term::Bound(value) => format!("{name} ± {}", text(*value)),
            Term::Factor(value) => format!("{name} × {}", short(*value)),
        });
    let cells = format!("in {} of up to {} cells", percent(errors.share), errors.samples);
    texts.chain([cells]).collect()
}
