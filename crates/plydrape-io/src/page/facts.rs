//! What was draped, in a few lines.

use crate::result::ResultFile;
use crate::store::shown::rounded;
use plydrape::layup::{Model, SlopeRule};
use plydrape::material::Section;
use plydrape::mold::{Face, Mold, Surface};
use plydrape::outcome::Summary;
use plydrape::scene::PlanMethod;
use serde::Serialize;

/// A name and what it stands for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(super) struct Fact {
    label: &'static str,
    value: String,
}

impl Fact {
    /// What a name stands for.
    pub fn new(label: &'static str, value: String) -> Self {
        Fact { label, value }
    }
}

/// Ply, material, mold, motion and model of a result.
pub(super) fn facts(result: &ResultFile) -> Vec<Fact> {
    // how the motion was found: planned, or as the scene gives it
    let scene = &result.scene;
    let motion = match (&result.plan, result.steps.last()) {
        (Some(plan), last) => format!(
            "planned by {}, {} drapes tried{}{}; {} s",
            match plan.method {
                PlanMethod::Path => "whole paths",
                PlanMethod::Stepwise => "steps",
            },
            plan.evaluations,
            match plan.refused {
                None => String::new(),
                Some(1) => ", one plan refused by the sample".into(),
                Some(refused) => format!(", {refused} plans refused by the sample"),
            },
            crate::store::shown::picked_up(plan)
                .map_or_else(String::new, |text| format!(", {text}")),
            shown(last.map_or(0.0, |step| step.time)),
        ),
        (None, Some(last)) => {
            let steps = if result.steps.len() == 1 { "step" } else { "steps" };
            format!("as the scene says, {} {steps}, {} s", result.steps.len(), shown(last.time))
        }
        (None, None) => "none".into(),
    };

    // in the order in which the page shows them
    let fact = Fact::new;
    vec![
        fact("Ply", crate::store::shown::ply(&scene.ply)),
        fact("Material", material(result)),
        fact("Mold", scene.mold.as_ref().map_or("none".into(), mold)),
        fact("Motion", motion),
        fact("Model", models(result)),
    ]
}

/// The model that decides, and the one beside it.
fn models(result: &ResultFile) -> String {
    let deciding = model(result, &result.summary);
    match &result.also {
        Some(also) => {
            format!(
                "{deciding}; for comparison, and judging nothing, {}",
                model(result, &also.summary)
            )
        }
        None => deciding,
    }
}

fn model(result: &ResultFile, summary: &Summary) -> String {
    match summary.model {
        Model::Sheet => match &summary.sheet {
            Some(report) => format!("sheet of {} nodes", report.nodes),
            None => "sheet".into(),
        },
        Model::Catenaries => {
            let slopes = match result.scene.settings.slopes {
                SlopeRule::MinForce => "least norm of the horizontal forces",
                SlopeRule::MomentBalance => "moments in balance at each gripper",
            };
            format!("catenaries, slopes by {slopes}")
        }
    }
}

fn material(result: &ResultFile) -> String {
    let material = &result.scene.ply.material;
    let section = match material.section {
        Section::Line { mass, flexural_rigidity } => {
            let [mass, rigidity] = [mass * 1e3, flexural_rigidity * 1e6].map(shown);
            format!("{mass} g/m, flexural rigidity {rigidity} N mm² a catenary")
        }
        Section::Areal { mass, warp_rigidity, weft_rigidity } => format!(
            "{} g/m², flexural rigidity {} N mm warp, {} N mm weft",
            shown(mass * 1e3),
            shown(warp_rigidity * 1e3),
            shown(weft_rigidity * 1e3),
        ),
    };
    let bends = if material.moment.iter().any(Option::is_some) {
        " at rest, moment over curvature from a table"
    } else {
        ""
    };
    format!("{}: {section}{bends} ({})", material.name, material.source)
}

fn mold(mold: &Mold) -> String {
    let mm = |length: f64| shown(length * 1e3);
    let side = |face: Face| match face {
        Face::Outside => "",
        Face::Inside => ", from inside",
    };

    // the kind of the mold and its sizes; what lies on a mold comes after the mold itself
    match mold {
        Mold::Plane(_) => "plane".into(),
        Mold::Cylinder(c) => format!("cylinder of radius {} mm{}", mm(c.radius), side(c.face)),
        Mold::Sphere(s) => format!("sphere of radius {} mm{}", mm(s.radius), side(s.face)),
        Mold::Torus(t) => format!(
            "torus of radii {} mm and {} mm{}",
            mm(t.ring_radius),
            mm(t.tube_radius),
            side(t.face)
        ),
        Mold::Graph(graph) => match &graph.surface {
            Surface::Saddle(s) => {
                format!("saddle of radii {} mm and {} mm", mm(s.radii[0]), mm(s.radii[1]))
            }
            Surface::Formula { z } => format!("z = {}", z.text()),
            Surface::HeightGrid(grid) => {
                let [nx, ny] = grid.size();
                format!("heights on a grid of {nx} × {ny}")
            }
            Surface::Front(_) => "a mold raised ahead of a front".into(),
        },
        Mold::Mesh(mesh) => format!("mesh of {} triangles", mesh.triangles().len()),
        Mold::Layered(layered) => {
            let count = layered.relief.0.len();
            let plies = if count == 1 { "ply" } else { "plies" };
            format!("{} with {count} {plies} on it", self::mold(&layered.mold))
        }
        Mold::Wavy(wavy) => format!("{} with waves on it", self::mold(&wavy.mold)),
    }
}

/// Four digits, no zeros behind them.
fn shown(value: f64) -> String {
    rounded(value, 4).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// A number is shown with the digits that it has, four at most.
    #[test]
    fn numbers_are_short() {
        for (value, text) in
            [(0.1 * 1e3, "100"), (0.0985 * 1e3, "98.5"), (1.0 / 3.0, "0.3333"), (0.0, "0")]
        {
            assert_eq!(shown(value), text);
        }
    }

    /// Every fact has a value.
    #[test]
    fn a_drape_is_told_in_five_facts() {
        let facts = facts(&sample::draped(4, 2, 3));
        assert_eq!(facts.len(), 5);
        assert!(facts.iter().all(|fact| !fact.value.is_empty()), "{facts:?}");
        assert!(facts[0].value.starts_with("4 × 2 grippers"));
    }
}
