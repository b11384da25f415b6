//! Grippers on mounts are commanded beyond their places: the pull that holds the ply taut, the press as it lands, and what a
//! plan tolerates with them.

use crate::common::{distance, drape_sheet, example, motion, parse};
use plydrape::errors::{Errors, Term};
use plydrape::layup::Stepping;
use plydrape::measure::Name;
use plydrape::outcome::{Tolerance, Watch};
use plydrape::planner;
use plydrape::planner::path::preload::{Preload, ends};
use plydrape::planner::path::{MoldHeights, Strategy, trajectory};
use plydrape::scene::Scene;
use std::ops::ControlFlow;

/// 4 × 3 grippers on mounts of 2 N/mm and 5 N/mm over a mold.
fn on_mounts(mold: &str) -> Scene {
    let text = format!(
        "[ply]\ngrippers = [4, 3]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"krogh2018\"\n[mold]\n{mold}\n\
         [grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"50 mm\"\norigin = \"centered\"\n\
         stiffness = {{ lateral = \"2 N/mm\", axial = \"5 N/mm\" }}\n\
         [target]\nseed = \"middle\"\n[motion]\nkind = \"straight\"\nsteps = 10\n"
    );
    parse(&text)
}

fn strategy(press: f64, pull: f64) -> Strategy {
    Strategy { press, pull, ..Strategy::flat() }
}

fn targets(scene: &Scene) -> Vec<[f64; 3]> {
    scene.layup.target.as_ref().expect("a target").grippers.clone()
}

/// On a flat array the pulls of free lines balance each other inside: an inner gripper is commanded to its place, one in the
/// middle of a border outwards alone, and all forces together and their moment about the middle are zero.
#[test]
fn pulls_of_a_flat_array_are_in_balance() {
    let scene = on_mounts("kind = \"plane\"");
    let strategy = strategy(0.0, 0.8);
    let preload = Preload::new(&scene, &strategy).expect("mounts");
    let raised: Vec<[f64; 3]> = targets(&scene).iter().map(|[x, y, z]| [*x, *y, z + 0.2]).collect();
    let commanded = preload.commanded(&raised, 1.0);
    let grid = scene.layup.ply.grid;
    let off = |id: [usize; 2]| {
        let n = grid.index(id);
        [0, 1, 2].map(|c| commanded[n][c] - raised[n][c])
    };
    for id in [[1, 1], [2, 1]] {
        assert!(off(id).iter().all(|c| c.abs() < 1e-12), "{:?}", off(id));
    }
    let [x, y, z] = off([0, 1]);
    assert!(x < -1e-4 && y.abs() < 1e-12 && z.abs() < 1e-12, "{:?}", off([0, 1]));
    let corner = off([3, 2]);
    assert!(corner[0] > 2.0 * -x && (corner[0] - corner[1]).abs() < 1e-12, "{corner:?}");
    let (mut sum, mut moment) = ([0.0; 3], 0.0);
    let middle = [0, 1].map(|c| raised.iter().map(|p| p[c]).sum::<f64>() / raised.len() as f64);
    for (a, b) in commanded.iter().zip(&raised) {
        let force = [0, 1, 2].map(|c| 2e3 * (a[c] - b[c]));
        (0..3).for_each(|c| sum[c] += force[c]);
        moment += (b[0] - middle[0]) * force[1] - (b[1] - middle[1]) * force[0];
    }
    assert!(sum.iter().all(|c| c.abs() < 1e-9) && moment.abs() < 1e-9, "{sum:?} {moment}");
}

/// A line at θ to yarns that do not stretch bears G L ε/(sin θ cos θ)²; a cup in the middle of a border, whose lines along the border are in
/// balance, is commanded outwards by that over the stiffness of its mount. Along the yarns the pull is that of the strategy.
#[test]
fn a_line_across_the_yarns_is_pulled_no_harder_than_it_bears() {
    let strategy = strategy(0.0, 0.8);
    let outwards = |warp: f64, shear: f64| {
        let scene = parse(&format!(
            "[ply]\nsize = [\"340 mm\", \"240 mm\"]\ngrippers = [4, 3]\ncell = [\"100 mm\", \"100 mm\"]\nwarp = \"{warp} deg\"\n\
             material = {{ tension = 1e6, mass = 0.3, bending_rigidity_warp = 2e-5, bending_rigidity_weft = 2e-5, shear_curve = {shear} }}\n\
             [mold]\nkind = \"plane\"\n[grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"50 mm\"\norigin = \"centered\"\npad_radius = \"15 mm\"\n\
             stiffness = {{ lateral = \"2 N/mm\", axial = \"5 N/mm\" }}\n\
             [target]\nseed = \"middle\"\n[motion]\nkind = \"straight\"\nsteps = 10\n"
        ));
        let preload = Preload::new(&scene, &strategy).expect("mounts");
        let raised: Vec<[f64; 3]> =
            targets(&scene).iter().map(|[x, y, z]| [*x, *y, z + 0.2]).collect();
        // the first of the second row of four
        distance(preload.commanded(&raised, 1.0)[4], raised[4])
    };
    for (warp, shear) in [(45.0_f64, 20.0), (45.0, 40.0), (-20.0, 20.0)] {
        let (sin, cos) = warp.to_radians().sin_cos();
        let bears = shear * 0.1 * strategy.pretension / (sin * cos).powi(2);
        let found = outwards(warp, shear);
        assert!((found / (bears / 2e3) - 1.0).abs() < 1e-6, "{warp}: {found} and {bears}");
    }
    assert!((outwards(1.0, 40.0) / outwards(0.0, 40.0) - 1.0).abs() < 1e-9);
    assert!(outwards(0.0, 40.0) > 1e-4);
}

/// At its place on a flat mold a gripper is commanded lower by what presses its mount with its share of the load, and a mount
/// that is stiffer by half as much.
#[test]
fn a_gripper_presses_with_its_share_of_the_load() {
    let mut scene = on_mounts("kind = \"plane\"");
    let strategy = strategy(1.0, 0.0);
    let depth = |scene: &Scene| targets(scene)[0][2] - ends(scene, &strategy)[0][2];
    let soft = depth(&scene);
    scene.layup.settings.pad.axial_stiffness = Some(1e4);
    let stiff = depth(&scene);
    assert!(soft > 0.0 && (soft / stiff - 2.0).abs() < 1e-9, "{soft} {stiff}");
    assert!(5e3 * soft <= scene.limits.most(Name::GripperLoad), "{soft}");
    scene.layup.settings.pad.axial_stiffness = None;
    assert_eq!(depth(&scene), 0.0, "a rigid axis is not commanded beyond");
}

/// A line over a hollow would be kept off the mold: in a bowl all pull is given up at the end, on a dome it is not.
#[test]
fn lines_over_a_hollow_are_given_up() {
    let bowl =
        "kind = \"sphere\"\nradius = \"0.8 m\"\nposition = [0, 0, \"0.8 m\"]\nside = \"inside\"";
    let dome = "kind = \"sphere\"\nradius = \"0.8 m\"\nposition = [0, 0, \"-0.8 m\"]";
    let [bowl, dome] = [bowl, dome].map(on_mounts);
    let largest = |scene: &Scene| {
        let ends = ends(scene, &strategy(0.0, 1.0));
        let off = ends.iter().zip(targets(scene)).map(|(a, b)| distance(*a, b));
        off.fold(0.0, f64::max)
    };
    assert!(largest(&bowl) < 1e-12, "{}", largest(&bowl));
    assert!(largest(&dome) > 1e-3, "{}", largest(&dome));
}

/// Where pads let go first over a hollow, grippers stay above it, by a tenth of a cell at most, and the line between two of them is left shorter than
/// its place by six deviations of what their errors do to its length, √2 of one gripper's; a ply that slides needs no slack. On a dome they
/// press as ever.
#[test]
fn a_ply_falls_slack_into_a_hollow_whose_pads_let_go_first() {
    let hollow = |friction: &str, side: &str, z: f64| {
        let text = format!(
            "[ply]\ngrippers = [2, 1]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"krogh2018\"\n[mold]\nkind = \"sphere\"\nradius = \"0.8 m\"\n\
             position = [0, 0, {z}]\nside = \"{side}\"\n[grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"50 mm\"\norigin = \"centered\"\n\
             stiffness = {{ lateral = \"2 N/mm\", axial = \"5 N/mm\" }}\n[errors]\ngripper = {{ position = {{ deviation = \"0.1 mm\" }} }}\n\
             [release]\norder = \"hollows-first\"\n[contact]\nfriction = {friction}\n[target]\nseed = \"middle\"\n[motion]\nkind = \"straight\"\nsteps = 10\n"
        );
        let scene = parse(&text);
        let (places, ends) = (targets(&scene), ends(&scene, &strategy(0.6, 0.8)));
        let mold = scene.layup.mold.expect("a mold");
        let along = |p: &[[f64; 3]]| p[1][0] - p[0][0];
        let tilt = (along(&places) / 2.0 / 0.8).asin();
        // the grippers rise along the normals, which lean together
        let leaning = if side == "inside" { 2.0 * 6e-3 * tilt.sin() } else { 0.0 };
        (mold.signed_distance(ends[0]), along(&places) - leaning - along(&ends))
    };
    let (above, shorter) = hollow("\"stick\"", "inside", 0.8);
    assert!((above - 6e-3).abs() < 5e-5, "{above}");
    assert!((shorter - 6.0 * 2_f64.sqrt() * 1e-4).abs() < 1e-5, "{shorter}");
    let (above, shorter) = hollow("0.3", "inside", 0.8);
    assert!((above - 6e-3).abs() < 1e-9 && shorter.abs() < 1e-9, "{above} {shorter}");
    let (below, shorter) = hollow("\"stick\"", "outside", -0.8);
    assert!(below < -1e-4 && shorter < 0.0, "{below} {shorter}");
}

/// Errors of 1 mm change the pull of a line between two mounts of 2 N/mm by 1.41 N (standard deviation), and three times that is
/// more than the largest pull, 2.5 N of a load of 10 N; those of 0.4 mm ask for 1.70 N of it, and those of 0.1 mm for less
/// than is pulled without errors.
#[test]
fn the_first_members_pull_against_the_errors_of_the_scene() {
    let pull = |deviation: Option<f64>| {
        let mut scene = on_mounts("kind = \"plane\"");
        scene.errors = deviation.map(|deviation| {
            let mut errors = Errors::default();
            errors.gripper.position = Term::Deviation(deviation);
            errors
        });
        Strategy::families(&scene, |shape| shape.slope)[0].pull
    };
    assert_eq!([pull(None), pull(Some(1e-4))], [0.6, 0.6]);
    let middle = pull(Some(4e-4));
    assert!((middle - 3.0 * 2e3 * 4e-4 / 2.0_f64.sqrt() / 2.5).abs() < 1e-12, "{middle}");
    assert_eq!(pull(Some(1e-3)), 1.0);
}

/// Height over the mold at the end (mm) of a drape without errors along a front, its steps without times.
fn height_along(scene: &Scene, front: Strategy) -> f64 {
    let heights = MoldHeights::new(scene).expect("a mold");
    let positions = trajectory(scene, &heights, front).expect("a target");
    let mut scene = scene.clone();
    scene.layup.motion = motion(positions);
    drape_sheet(&scene).summary.last.value(Name::Height).expect("a mold")
}

/// A ring comes to the ends of a long array along whole lines of cups, and ridges higher than 0.5 mm stay beside them. A low rhombic
/// front crosses these lines obliquely, and leaves none.
#[test]
fn a_low_rhombic_front_leaves_no_ridges_at_the_ends_of_a_long_array() {
    let mut scene = parse(
        "[cell]\npreset = \"usual\"\n[ply]\ngrippers = [6, 4]\ncell = [\"100 mm\", \"100 mm\"]\noverhang = \"10 mm\"\n\
         material = \"prepreg_warm\"\n[mold]\nkind = \"sphere\"\nradius = \"0.8 m\"\nposition = [0, 0, \"-0.8 m\"]\n\
         [grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"200 mm\"\norigin = \"centered\"\n\
         [target]\nseed = \"middle\"\n[contact]\nfriction = \"stick\"\n",
    );
    scene.errors = None;
    let ring = Strategy::families(&scene, |shape| shape.slope)[0];
    let low = Strategy::racing_first(&scene, |shape| shape.slope);
    let rhombic = *low.iter().rfind(|front| front.squareness < -1.0).expect("a rhombic front");
    assert_eq!([ring.pull, ring.press], [rhombic.pull, rhombic.press]);
    let [ring, rhombic] = [ring, rhombic].map(|front| height_along(&scene, front));
    assert!(ring > 0.5 && rhombic < 0.5, "ring {ring} mm, rhombic {rhombic} mm");
}

/// A dome whose drape begins at a corner shears its ply by 10 degrees. In the air it buckles across the cells, and ridges stay, unless its grippers
/// pull it taut and the front starts where it is not sheared.
#[test]
fn a_taut_front_from_the_seed_keeps_a_sheared_ply_flat() {
    let mut scene = parse(
        "[cell]\npreset = \"usual\"\n[ply]\ngrippers = [5, 3]\ncell = [\"110 mm\", \"100 mm\"]\nmaterial = \"dry_carbon\"\n\
         [mold]\nkind = \"sphere\"\nradius = \"0.6 m\"\nposition = [0, 0, \"-0.6 m\"]\n\
         [grippers]\nspacing = [\"108 mm\", \"98 mm\"]\nheight = \"200 mm\"\norigin = \"centered\"\n\
         [target]\nseed = [\"385 mm\", \"25 mm\"]\norigin = [\"165 mm\", \"-75 mm\"]\ngenerators = \"least-shear\"\n\
         [contact]\nfriction = \"stick\"\n",
    );
    scene.errors = None;
    let fronts = Strategy::racing_first(&scene, |shape| shape.slope);
    let taut = fronts[0];
    assert_eq!(taut.start, [0.875, 0.125]);
    let loose = *fronts.iter().rfind(|front| front.squareness == 0.0).expect("a ring");
    let [taut, loose] = [taut, loose].map(|front| height_along(&scene, front));
    assert!(taut < 0.5 * loose && loose > 1.0, "taut {taut} mm, loose {loose} mm");
}

/// The first fronts of a strip, which has no width between its grippers, begin in its seed and are numbers.
#[test]
fn the_first_fronts_of_a_strip_begin_in_its_seed() {
    let scene = parse(
        "[cell]\npreset = \"usual\"\n[ply]\ngrippers = [4, 1]\ncell = [\"100 mm\", \"100 mm\"]\noverhang = \"10 mm\"\nmaterial = \"prepreg_warm\"\n\
         [mold]\nkind = \"plane\"\n[grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"50 mm\"\norigin = \"centered\"\n\
         [target]\nseed = [\"0 mm\", \"0 mm\"]\n",
    );
    let fronts = Strategy::racing_first(&scene, |shape| shape.slope);
    assert_eq!(fronts[0].start, [0.0, 0.5]);
    assert!(fronts.iter().all(Strategy::is_sound), "{fronts:?}");
}

/// Where a mold curves one way, ellipses along its straight way race first: along the axis of a cylinder however it is turned, and along a ramp,
/// which is straight in its middle. A sphere has no such way.
#[test]
fn first_fronts_lie_along_the_straight_way_of_a_mold() {
    let cases = [
        ("kind = \"cylinder\"\nradius = \"0.5 m\"\nposition = [0, 0, \"-0.5 m\"]", 0.0),
        (
            "kind = \"formula\"\nz = \"0.05*tanh(x/0.15)\"\nx = [\"-0.9 m\", \"0.9 m\"]\ny = [\"-0.9 m\", \"0.9 m\"]",
            90.0,
        ),
    ];
    for (mold, straight) in cases {
        for turn in [0.0, 25.0] {
            let mold = format!("{mold}\nrotation = [0, 0, \"{turn} deg\"]");
            let fronts = Strategy::racing_first(&on_mounts(&mold), |shape| shape.slope);
            let ellipses: Vec<_> = fronts.iter().filter(|front| front.ratio > 1.0).collect();
            assert_eq!(ellipses.len(), 3, "{mold}");
            for front in ellipses {
                let off = front.angle - f64::to_radians(straight + turn);
                assert!(off.sin().abs() < 1e-6, "{mold}: {}°", front.angle.to_degrees());
            }
        }
    }
    let sphere = on_mounts("kind = \"sphere\"\nradius = \"0.6 m\"\nposition = [0, 0, \"-0.6 m\"]");
    let fronts = Strategy::racing_first(&sphere, |shape| shape.slope);
    assert!(fronts.iter().all(|front| front.ratio == 1.0), "{fronts:?}");
}

/// A mold that is nearly a cylinder of radius 0.46 m: behind a low ring ridges stay, behind an ellipse along its straight way, less
/// sharp and steeper, none.
#[test]
fn a_ply_lies_behind_an_ellipse_along_the_straight_way_of_its_mold() {
    let mut scene = parse(
        "[cell]\npreset = \"usual\"\n[ply]\ngrippers = [4, 4]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"prepreg_warm\"\n\
         [mold]\nkind = \"formula\"\nz = \"-x^2/2 + 3*x^3/5 - 9*y^2/10 + 4*x*y/5\"\nx = [\"-60 mm\", \"380 mm\"]\ny = [\"-60 mm\", \"380 mm\"]\n\
         [grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"50 mm\"\norigin = \"centered\"\n\
         [target]\nseed = \"middle\"\norigin = [\"160 mm\", \"160 mm\"]\n",
    );
    scene.errors = None;
    let fronts = Strategy::racing_first(&scene, |shape| shape.slope);
    let ellipse = *fronts.iter().find(|front| front.ratio > 1.0 && front.pull == 1.0).expect("one");
    let [ring, ellipse] = [fronts[0], ellipse].map(|front| height_along(&scene, front));
    assert!(ellipse < 0.5 * ring && ring > 0.5, "ring {ring} mm, ellipse {ellipse} mm");
}

/// However hard its lines are pulled, a corner bears 0.8 of its load: the ply's shear and the errors of the grippers add to it.
#[test]
fn a_corner_bears_four_fifths_of_its_load() {
    let scene = on_mounts("kind = \"plane\"");
    let most = scene.limits.most(Name::GripperLoad);
    for pull in [1.5, 2.0] {
        let preload = Preload::new(&scene, &strategy(0.0, pull)).expect("mounts");
        let raised: Vec<[f64; 3]> =
            targets(&scene).iter().map(|[x, y, z]| [*x, *y, z + 0.2]).collect();
        let load = 2e3 * distance(preload.commanded(&raised, 1.0)[0], raised[0]);
        assert!((load / (0.8 * most) - 1.0).abs() < 1e-6, "{load} N of {most} N");
    }
}

/// However little a front presses when its cups land, a pad that lets go presses with 0.4 of the largest press, half of the load: else the ply
/// beside it may hang, and draws back. Farther away than a hundredth of a cell or two it presses as the front says.
#[test]
fn a_pad_presses_before_it_lets_go() {
    let scene = on_mounts("kind = \"plane\"");
    let depth = |press: f64, up: f64| {
        let preload = Preload::new(&scene, &strategy(press, 0.0)).expect("mounts");
        let places: Vec<[f64; 3]> =
            targets(&scene).iter().map(|[x, y, z]| [*x, *y, z + up]).collect();
        5e3 * (places[0][2] - preload.commanded(&places, 1.0)[0][2])
    };
    let most = 0.5 * scene.limits.most(Name::GripperLoad);
    assert!((depth(0.0, 0.0) - 0.4 * most).abs() < 1e-9, "{}", depth(0.0, 0.0));
    assert!((depth(0.7, 0.0) - 0.7 * most).abs() < 1e-9, "{}", depth(0.7, 0.0));
    assert_eq!(depth(0.0, 2e-3), 0.0);
}

/// The paper's example, planned for mounts of 2 N/mm, tolerates errors ten times as large as a plan for rigid grippers.
#[test]
fn mounts_tolerate_ten_times_the_errors_of_rigid_grippers() {
    let rigid = example("01_flat_sheared_mold");
    let mut mounted = rigid.clone();
    mounted.layup.settings.pad.lateral_stiffness = Some(2e3);
    mounted.layup.settings.pad.axial_stiffness = Some(2e3);
    let tolerated = |scene: &Scene| {
        let go = &mut |_: &planner::Progress| ControlFlow::Continue(());
        let planned = planner::plan(scene, None, go).expect("a plan");
        let mut scene = scene.clone();
        scene.layup.motion = planned.motion.steps();
        scene.layup.settings.contact.stepping = Stepping::Cut;
        let watch = Watch { stop: &|| false, done: &|_, _| {} };
        Tolerance::new(&scene, &watch).expect("not stopped").gripper_mm
    };
    let [rigid, mounted] = [&rigid, &mounted].map(tolerated);
    assert!(mounted > 10.0 * rigid, "rigid {rigid}, on mounts {mounted}");
}
