//! Catenaries between cups that are no whole array along the yarns: some cups off, and rows at 45° to the yarns.

use crate::common::{self, distance, drape, hung, lines};
use plydrape::catenary::{EndCondition, Profile, Span};
use plydrape::equilibrium::Solver;
use plydrape::layup::SlopeRule;
use plydrape::ply::{Kind, Ply};
use plydrape::scene::Scene;
use plydrape_io::scene;
use std::path::Path;

/// A scene whose table [ply] has these keys, drape by its catenaries.
fn parse(ply: &str, rest: &str) -> Scene {
    let text = format!(
        "[model]\nkind = \"catenaries\"\n[ply]\n{ply}\nmaterial = \"krogh2018\"\n\
         [grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n{rest}"
    );
    common::parse(&text)
}

const CYLINDER: &str = "origin = \"centered\"\n[mold]\nkind = \"cylinder\"\nradius = 0.5\nposition = [0, 0, -0.5]\n\
    [motion]\nkind = \"straight\"\nsteps = 6\n[target]\nseed = \"middle\"\n";

/// 40 mm of fabric around a square array of 100 mm.
fn array(size: [usize; 2], more: &str) -> String {
    let [a, b] = size.map(|count| 0.1 * count as f64 - 0.02);
    format!("grippers = {size:?}\ncell = [0.1, 0.1]\nsize = [{a}, {b}]\n{more}")
}

/// A ply that is cut hangs and lands as the same ply without a cut: same forces, same lengths, same contact.
#[test]
fn a_whole_rectangle_that_is_cut_has_the_states_of_its_array() {
    let array = "grippers = [4, 3]\ncell = [0.1, 0.1]";
    let [told, cut] = [String::new(), "\nsize = [0.3, 0.2]".into()]
        .map(|size: String| drape(&parse(&format!("{array}{size}"), CYLINDER)));
    assert!(lines(told.steps.last().unwrap()).iter().any(|line| line.contact.is_some()));
    for (a, b) in told.steps.iter().zip(&cut.steps) {
        // the middle of the target is found once from indices and once from places: the same to rounding
        for (p, q) in hung(a).cells.iter().zip(&hung(b).cells) {
            assert_eq!((p.cell, p.shearing), (q.cell, q.shearing));
            assert!((p.shear_deg - q.shear_deg).abs() < 1e-9);
        }
        for (p, q) in lines(a).iter().zip(lines(b)) {
            assert_eq!(
                (p.kind, p.from, p.to, p.spans.len()),
                (q.kind, q.from, q.to, q.spans.len())
            );
            assert!((p.length - q.length).abs() < 1e-12);
            for (s, t) in p.spans.iter().zip(&q.spans) {
                let [force, other] = [s.force, t.force].map(|force| force.unwrap_or(0.0));
                assert!((force - other).abs() < 1e-6 * (1.0 + force.abs()), "{force} {other}");
            }
        }
    }
}

fn solved(scene: &Scene, spacing: f64) -> (Solver, Vec<[f64; 3]>) {
    let ply = &scene.layup.ply;
    let position = |n: usize| {
        let [i, j] = ply.id(n).map(|k| spacing * k as f64);
        [i, j, 0.05]
    };
    let positions: Vec<_> = (0..ply.grippers()).map(position).collect();
    let mut solver = Solver::new(ply, &scene.layup.settings);
    let contacts = vec![None; ply.lines().catenaries()];
    let equilibrium = solver.solve(&positions, &contacts);
    assert_eq!(equilibrium.status, plydrape::equilibrium::Status::Converged);
    (solver, positions)
}

/// Vertical forces of all fiber lines on the cups (N), each with the share that is the ply's.
fn borne(ply: &Ply, solver: &Solver) -> f64 {
    let lines = ply.lines();
    let elements = solver.problem().elements.iter().enumerate();
    let edges = elements.filter(|(_, element)| element.catenary < lines.edges());
    edges
        .map(|(n, element)| {
            let profile = Profile::new(&solver.span(n), solver.force(n).expect("it hangs"));
            let [a, b] = [0.0, element.run].map(|x| profile.station(x).vertical_force);
            lines.tributary(element.catenary) * (b - a)
        })
        .sum()
}

/// Without the cup in the middle of 3 × 3, its row and its column are spans of twice the length: each hangs as the closed form of
/// such a span, and all lines together bear the weight of the ply between its cups.
#[test]
fn a_span_over_a_missing_cup_hangs_as_one_of_twice_the_length() {
    let scene = parse(&array([3, 3], "array = { holds = [\"###\", \"#.#\", \"###\"] }"), "");
    let (ply, settings) = (&scene.layup.ply, &scene.layup.settings);
    assert_eq!([ply.grippers(), ply.lines().catenaries()], [8, 10]);
    let (solver, _) = solved(&scene, 0.098);
    let line = ply.line(Kind::EdgeU);
    let span = Span {
        run: 0.196,
        rise: 0.0,
        length: 0.2,
        ends: [EndCondition::Free; 2],
        weight: line.mass * settings.gravity,
        flexural_rigidity: line.flexural_rigidity,
        axial_stiffness: settings.axial_stiffness,
    };
    let force = span.solve(None).force.unwrap();
    let sag = |span: &Span, force: f64| -Profile::new(span, force).station(0.5 * span.run).z;
    // the exact flexible catenary of 100 mm sags by 8.634 mm; twice as long, by twice as much, less what bending takes
    assert!((sag(&span, force) - 2.0 * 8.634e-3).abs() < 0.2e-3, "{}", sag(&span, force));
    let long = (0..solver.problem().elements.len()).filter(|n| solver.span(*n).run > 0.15);
    let mut count = 0;
    for n in long {
        let (span, found) = (solver.span(n), solver.force(n).unwrap());
        assert!((found - force).abs() < 1e-8 * force, "{found} {force}");
        assert!((sag(&span, found) - sag(&span, force)).abs() < 1e-10);
        count += 1;
    }
    assert_eq!(count, 2);

    // lines of 0.3143 kg/m stand for strips of 100 mm; chords are 98 mm of 100 mm long
    let weight = 0.3143 / 0.1 * settings.gravity * 0.2 * 0.196;
    let borne = borne(ply, &solver);
    assert!((borne - weight).abs() < 1e-6 * weight, "{borne} {weight}");
}

/// Where cups are off, and where rows cross the yarns, what has landed and what hangs of each line add up to its set length.
#[test]
fn contact_and_free_lengths_add_up_to_the_set_lengths() {
    let off = array([4, 4], "array = { holds = [\"####\", \"#.##\", \"####\", \"###.\"] }");
    let bias = array([4, 3], "warp = \"45 deg\"");
    let bias_target =
        CYLINDER.replace("seed = \"middle\"", "seed = \"middle\"\ndirection = \"45 deg\"");
    for (ply, rest) in [(off.as_str(), CYLINDER), (bias.as_str(), bias_target.as_str())] {
        let scene = parse(ply, rest);
        let drape = drape(&scene);
        assert_eq!(drape.steps.len(), 6);
        let last = drape.steps.last().unwrap();
        assert!(lines(last).iter().filter(|line| line.contact.is_some()).count() > 10);
        for line in drape.steps.iter().flat_map(lines) {
            let lying = line.contact.as_ref().map_or(0.0, |contact| contact.length());
            let free: f64 = line.spans.iter().map(|span| span.length).sum();
            assert!((lying + free - line.length).abs() < 1e-9, "{line:?}");
        }
    }
}

/// A square of 3 × 3 cups at 45° to the yarns, drawn out along its rows in a plane: the fibers keep their length, so the
/// columns' set length is √(d² − s₁²), and the shear angle is that between the fibers' directions.
#[test]
fn a_ply_at_45_degrees_shears_by_the_trellis_rule() {
    for (warp, slopes) in [("45 deg", SlopeRule::MinForce), ("-45 deg", SlopeRule::MomentBalance)] {
        let mut scene = parse(&array([3, 3], &format!("warp = \"{warp}\"")), "");
        scene.layup.settings.slopes = slopes;
        let (ply, lines) = (&scene.layup.ply, scene.layup.ply.lines());
        let d = 0.1 * f64::sqrt(2.0);
        let (long, short) = (0.108, f64::sqrt(d * d - 0.108 * 0.108));
        // a little less across, so that fibers and columns hang
        let short_now = short - 5e-4;
        let position = |n: usize| {
            let [i, j] = ply.id(n).map(|k| k as f64);
            [long * i, short_now * j, 0.05]
        };
        let positions: Vec<_> = (0..9).map(position).collect();
        let mut solver = Solver::new(ply, &scene.layup.settings);
        solver.solve(&positions, &vec![None; lines.catenaries()]);
        let problem = solver.problem();
        let (mut columns, mut rows) = (0, 0);
        for n in lines.edges()..lines.catenaries() {
            let [from, to] = lines.ends(n).map(|gripper| ply.id(gripper));
            if from[1] == to[1] {
                rows += 1;
                assert!((problem.stretched(n).unwrap() - long).abs() < 1e-15);
                assert!(problem.elements.iter().all(|element| element.catenary != n));
            } else {
                columns += 1;
                let own = problem.elements.iter().find(|element| element.catenary == n).unwrap();
                assert!((own.length - short).abs() < 1e-15, "{} {short}", own.length);
            }
        }
        assert_eq!([rows, columns], [6, 6]);
        // fibers whose ends are apart by `long` and `short` cross at 2 atan(long/short)
        let independent = 2.0 * (long / short).atan() - std::f64::consts::FRAC_PI_2;
        for (cell, shearing) in lines.cells().iter().zip(&problem.shearing) {
            let (path, _) = shearing.unwrap();
            let angle = plydrape::ply::shear::angle(cell.trellis, path);
            assert!((angle - independent).abs() < 1e-12, "{angle} {independent}");
        }
    }
}

/// A cylinder can be unrolled: a ply at 45° to its axis that lies on it has fibers of their length along the mold, and no shear.
#[test]
fn a_ply_at_45_degrees_rolls_on_a_cylinder_without_shear() {
    let rest = CYLINDER.replace("seed = \"middle\"", "seed = \"middle\"\ndirection = \"45 deg\"");
    let scene = parse(&array([4, 3], "warp = \"45 deg\""), &rest);
    let (ply, lines) = (&scene.layup.ply, scene.layup.ply.lines());
    let (mold, target) =
        (scene.layup.mold.as_ref().unwrap(), &scene.layup.target.as_ref().unwrap().grippers);
    for n in 0..lines.catenaries() {
        let [a, b] = lines.ends(n).map(|gripper| target[gripper]);
        let length = lines.flat_length(n, 1.0);
        // the net of the ideal drape has cells of millimeters
        assert!((mold.path_length(a, b) - length).abs() < 1e-5, "{}", mold.path_length(a, b));
        // rows run along the axis; fibers wind around it
        assert!(n >= lines.edges() || distance(a, b) < length);
    }
    let mut solver = Solver::new(ply, &scene.layup.settings);
    solver.solve(target, &vec![None; lines.catenaries()]);
    for (cell, shearing) in lines.cells().iter().zip(&solver.problem().shearing) {
        let angle =
            shearing.map_or(0.0, |(path, _)| plydrape::ply::shear::angle(cell.trellis, path));
        assert!(angle < 1e-4, "{angle}");
    }
}

/// A level sheet of 45° that is slack in all directions hangs in all of its lines, and its fiber lines bear its weight.
#[test]
fn a_slack_ply_at_45_degrees_hangs_in_all_of_its_lines() {
    let scene = parse(&array([4, 3], "warp = \"45 deg\""), "");
    let (ply, lines) = (&scene.layup.ply, scene.layup.ply.lines());
    let (solver, _) = solved(&scene, 0.098);
    assert_eq!(solver.problem().elements.len(), lines.catenaries());
    let weights = solver.problem().elements.iter().filter(|e| e.catenary < lines.edges());
    let weight: f64 = weights.map(|e| lines.tributary(e.catenary) * e.weight * e.run).sum();
    assert!((borne(ply, &solver) - weight).abs() < 1e-6 * weight);
    // in the middle of a cell the fibers hang lower than the rows do at its sides
    let middle = |n: usize| {
        let (span, force) = (solver.span(n), solver.force(n).unwrap());
        Profile::new(&span, force).station(0.5 * span.run).z
    };
    assert!(middle(0) < 0.0);
}

/// Rows at neither 0° nor 45° to the yarns have no catenaries, and a scene that asks for them says so.
#[test]
fn rows_at_30_degrees_have_no_catenaries() {
    let ply = array([3, 3], "warp = \"30 deg\"");
    let text = |model: &str| {
        format!(
            "[model]\nkind = \"{model}\"\n[ply]\n{ply}\nmaterial = \"krogh2018\"\n\
             [grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n"
        )
    };
    let parse = |model: &str| scene::parse(&text(model), Path::new(""), "scene");
    assert!(!parse("sheet").unwrap().scene.layup.ply.has_lines());
    let error = parse("catenaries").err().unwrap().to_string();
    assert!(error.contains("at 45° to them"), "{error}");
}

/// Two cells at 45° beside each other of which only the first is drawn out: its own column gets what the trellis leaves, the last
/// one the flat length, and the one between them the mean of both by squares.
#[test]
fn a_side_of_two_cells_has_the_mean_of_what_they_leave_it() {
    let scene = parse(&array([3, 2], "warp = \"45 deg\""), "");
    let (ply, lines) = (&scene.layup.ply, scene.layup.ply.lines());
    let short = f64::sqrt(2.0 * 0.1 * 0.1 - 0.108 * 0.108);
    let position = |n: usize| {
        let [i, j] = ply.id(n);
        [[0.0, 0.108, 0.108 + 0.099][i], (short - 5e-4) * j as f64, 0.05]
    };
    let positions: Vec<_> = (0..6).map(position).collect();
    let mut solver = Solver::new(ply, &scene.layup.settings);
    solver.solve(&positions, &vec![None; lines.catenaries()]);
    assert!(solver.problem().shearing[0].is_some() && solver.problem().shearing[1].is_none());
    let mean = f64::sqrt(0.5 * (short * short + 0.1 * 0.1));
    for (column, expected) in [short, mean, 0.1].into_iter().enumerate() {
        let is_column = |n: &usize| lines.ends(*n).map(|gripper| ply.id(gripper)[0]) == [column; 2];
        let n = (lines.edges()..lines.catenaries()).find(is_column).unwrap();
        let element = solver.problem().elements.iter().find(|element| element.catenary == n);
        let length = element.unwrap().length;
        assert!((length - expected).abs() < 1e-15, "{column}: {length} {expected}");
    }
}
