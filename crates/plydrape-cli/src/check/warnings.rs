//! What is possible but hardly meant: places far off, plies of no known cloth, grippers in the mold.

use super::motion::longest;
use crate::mesh;
use crate::numbers::{millimeters, rounded, short};
use plydrape::bodies::Obstacle;
use plydrape::clearance;
use plydrape::layup::Model;
use plydrape::material::Section;
use plydrape::measure::Name;
use plydrape::mold::Mold;
use plydrape::planner::infeasible_limits::with_spring_back;
use plydrape::ply::gripper_name;
use plydrape::scene::Scene;
use plydrape_io::result::sheet::SheetSize;
use plydrape_io::scene::SceneFile;
use plydrape_io::text::foreseen::{foreseen, infeasible};

/// Straight way of a gripper, in diagonals of the ply, beyond which a place must be a slip: even a table on the other
/// side of a cell is a few of them away.
const FAR: f64 = 20.0;
/// Mass of plies (kg/m²): the lightest woven ones, of spread tow, weigh some 0.05; the heaviest, rovings, 3D weaves
/// and stitched stacks with their resin, stay below 10.
const PLIES: [f64; 2] = [0.05, 10.0];
/// Nodes of a sheet, as a multiple of those that its mesh needs, from which on the rows of the cups are what costs.
const FINE: f64 = 2.0;
/// Most places of grippers that are looked at in a motion.
const LOOKS: usize = 100_000;

/// Every warning, in a sentence.
pub(super) fn warnings(scene: &SceneFile) -> Vec<String> {
    let mesh = mesh::warnings(scene.layup.mold.as_ref(), scene.mesh.as_ref());
    let hardly_meant = far(scene).into_iter().chain(mass(scene)).chain(mesh);
    let below = below(scene);
    // said once
    let seen: &[Name] = if below.is_empty() { &[] } else { &[Name::OffMold] };
    let of_cell = standing_in_mold(scene).into_iter().chain(around_start(scene));
    let of_plan = foreseen(scene).into_iter().chain(fine_mesh(scene)).chain(unplanned(scene, seen));
    let notices = scene.notices.iter().cloned();
    notices.chain(hardly_meant).chain(below).chain(of_cell).chain(of_plan).collect()
}

/// Rows of cups across the yarns that make many lines of nodes.
fn fine_mesh(scene: &SceneFile) -> Option<String> {
    let layup = &scene.layup;
    let cut = layup.ply.cut.as_ref().filter(|_| layup.settings.model == Model::Sheet)?;
    let SheetSize { nodes, mesh, .. } = SheetSize::new(scene).ok()?;
    let least = cut.outline.area() / (mesh * mesh);
    let times = nodes as f64 / least;
    (times > FINE && cut.turn != 0.0).then(|| {
        format!(
            "the cups are in so many rows along the yarns that the sheet has {nodes} nodes, {times:.1} times those of its mesh of {} mm, and a drape takes longer than that many times; a square pitch at 45°, or rows along the yarns, need fewer lines",
            millimeters(mesh)
        )
    })
}

/// Obstacles that stand in the mold.
fn standing_in_mold(scene: &SceneFile) -> Vec<String> {
    let obstacles = scene.layup.bodies.obstacles();
    let sentence = |(n, depth): (usize, f64)| {
        format!(
            "obstacle {} reaches {} mm into the mold; see whether its place is right, or leave it out where the mold is",
            obstacles[n].name,
            millimeters(rounded(depth))
        )
    };
    clearance::standing_in_mold(&scene.layup).into_iter().map(sentence).collect()
}

/// Obstacles in which grippers start.
fn around_start(scene: &SceneFile) -> Vec<String> {
    let start = scene.layup.start();
    let sentence = |obstacle: &Obstacle| {
        let [low, high] = obstacle.shape.bounds();
        let inside = |place: &[f64; 3]| {
            let own = obstacle.pose.local(*place);
            (0..3).all(|n| low[n] < own[n] && own[n] < high[n])
        };
        let first = start.iter().position(inside)?;
        Some(format!(
            "gripper {} starts inside obstacle {}; move the start or the obstacle",
            gripper_name(scene.layup.ply.id(first)),
            obstacle.name
        ))
    };
    scene.layup.bodies.obstacles().iter().filter_map(sentence).collect()
}

/// Limits that no plan can keep, but for those that were `seen`, and what a plan is refused for.
fn unplanned(scene: &SceneFile, seen: &[Name]) -> Vec<String> {
    if scene.layup.target.is_none() {
        return Vec::new();
    }
    let mut limits = with_spring_back(scene, true, &|| false);
    limits.retain(|verdict| !seen.contains(&verdict.name));
    let refusal = scene.plan_refusal.iter().map(|refusal| {
        format!("`plydrape plan` refuses this scene: {}; {}", refusal.message, refusal.help)
    });
    infeasible(&limits).into_iter().chain(refusal).collect()
}

/// A way many times longer than the ply.
fn far(scene: &Scene) -> Option<String> {
    let ply = &scene.layup.ply;
    let [low, high] = ply.bounds(0.0);
    let sides = [0, 1].map(|n| high[n] - low[n]);
    let diagonal = sides[0].hypot(sides[1]);
    let (gripper, way) = longest(scene).filter(|(_, way)| *way > FAR * diagonal)?;
    let (to, keys) = match scene.layup.target {
        Some(_) => ("its target", "[grippers], [target] and [mold]"),
        None => ("where its motion ends", "the motion's file"),
    };
    Some(format!(
        "gripper {} starts {} m from {to}, {:.0} times the diagonal of the ply; see whether the units and origins in {keys} are right",
        gripper_name(gripper),
        short(rounded(way)),
        way / diagonal
    ))
}

/// A mass per area that no ply has. A mass per length is that of a strip one cell wide, as wide as a square cell of
/// the same area.
fn mass(scene: &Scene) -> Option<String> {
    let [a, b] = scene.layup.ply.cell;
    // mass per area, how it is said, and the same number in grams
    let (areal, what, grams) = match scene.layup.ply.material.section {
        Section::Areal { mass, .. } => {
            (mass, "the material has".to_string(), format!("{} g/m^2", short(mass)))
        }
        Section::Line { mass, .. } => {
            let width = (a * b).sqrt();
            let what = format!(
                "{} kg/m of a strip one cell wide, {} mm, makes",
                short(mass),
                millimeters(rounded(width))
            );
            (mass / width, what, format!("{} g/m", short(mass)))
        }
    };

    // what some ply may have is not warned of
    let [least, most] = PLIES;
    let is_of_a_ply = |areal: f64| (least..=most).contains(&areal);
    if is_of_a_ply(areal) {
        return None;
    }

    // where a thousandth of it would be right, grams were likely meant
    let side = if areal > most { "more" } else { "less" };
    let remedy = if is_of_a_ply(1e-3 * areal) {
        format!("did you mean mass = \"{grams}\"?")
    } else {
        "see whether the unit of `mass` is right".into()
    };
    let areal = short(rounded(areal));
    Some(format!(
        "{what} {areal} kg/m², {side} than plies have ({least} to {most} kg/m²); {remedy}"
    ))
}

/// Depth of a place below the mold (m); none beside it, where nothing is above or below.
fn depth(mold: &Mold, place: [f64; 3]) -> f64 {
    match mold.highest_point([place[0], place[1]]) {
        Some(_) => -mold.signed_distance(place),
        None => f64::NEG_INFINITY,
    }
}

/// The deepest of some grippers and its depth (m).
fn deepest(mold: &Mold, grippers: &[[f64; 3]]) -> Option<(usize, f64)> {
    let depths = grippers.iter().map(|place| depth(mold, *place)).enumerate();
    depths.max_by(|a, b| a.1.total_cmp(&b.1))
}

/// A target in the mold, and a motion that penetrates deeper than its target.
fn below(scene: &Scene) -> Vec<String> {
    let Some(mold) = &scene.layup.mold else {
        return Vec::new();
    };
    let mut out = Vec::new();
    let name = |gripper: usize| format!("gripper {}", gripper_name(scene.layup.ply.id(gripper)));
    let mm = |depth: f64| millimeters(rounded(depth));
    // a target deeper in the mold than the limit
    let mut allowed = scene.limits.most(Name::Penetration);
    let target = scene.layup.target.as_ref().and_then(|target| deepest(mold, &target.grippers));
    if let Some((gripper, depth)) = target.filter(|(_, depth)| *depth > allowed) {
        allowed = depth;
        out.push(format!(
            "the target of {} lies {} mm below the mold, where limits.penetration allows {} mm; raise the target or lower the mold",
            name(gripper),
            mm(depth),
            mm(scene.limits.most(Name::Penetration))
        ));
    }

    // a motion that is deeper than the limit and than its target
    if let Some((step, gripper, depth)) =
        deepest_step(scene, mold).filter(|(.., depth)| *depth > allowed)
    {
        out.push(format!(
            "in step {} {} is {} mm below the mold, where limits.penetration allows {} mm; start higher, or come from above",
            step + 1,
            name(gripper),
            mm(depth),
            mm(scene.limits.most(Name::Penetration))
        ));
    }
    out
}

/// Where the motion is deepest: step, gripper, depth (m).
fn deepest_step(scene: &Scene, mold: &Mold) -> Option<(usize, usize, f64)> {
    let steps = &scene.layup.motion.positions;
    let stride = (steps.len() * scene.layup.ply.grippers()).div_ceil(LOOKS).max(1);
    let looks = (0..steps.len()).step_by(stride).chain(steps.len().checked_sub(1));
    let depths = looks.filter_map(|step| {
        deepest(mold, &steps[step]).map(|(gripper, depth)| (step, gripper, depth))
    });
    depths.max_by(|a, b| a.2.total_cmp(&b.2))
}
