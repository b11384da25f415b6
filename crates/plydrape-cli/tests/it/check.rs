//! `plydrape check` as a user reads it: where the ply starts and shall end, and warnings of what can hardly be meant.

use crate::common::{command, example, one_line, text};
use std::process::{Command, Output};

/// Grippers over a flat mold, all numbers in a unit of length to come.
const SCENE: &str = "\
[model]
kind = \"catenaries\"

[ply]
grippers = [4, 2]
cell = [\"100 LL\", \"100 LL\"]
material = { mass = \"314 g/m^2\", bending_rigidity_warp = 0, bending_rigidity_weft = 0 }

[mold]
kind = \"plane\"

[grippers]
spacing = [\"98 LL\", \"98 LL\"]
height = \"75 LL\"
origin = [\"10 LL\", \"-20 LL\"]

[target]
";

fn check(scene: &str, flags: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, scene).unwrap();
    command().arg("check").arg(&file).args(flags).output().unwrap()
}

/// A ply that is cut, with an array of 7 × 4 cups that is 10 mm off its middle, under a lamp and beside a post.
const CUT: &str = "\
[ply]
size = [\"900 mm\", \"500 mm\"]
warp = \"45 deg\"
holes = [{ middle = [\"300 mm\", \"175 mm\"], diameter = \"120 mm\" }]
grippers = [7, 4]
cell = [\"160 mm\", \"150 mm\"]
array = { middle = [\"460 mm\", \"250 mm\"], partly = \"leave-off\" }
material = \"prepreg_warm\"

[mold]
kind = \"cylinder\"
radius = \"2 m\"
position = [0, 0, \"-2 m\"]

[grippers]
pad_radius = \"20 mm\"
spacing = [\"158 mm\", \"148 mm\"]
height = \"60 mm\"
origin = \"centered\"

[target]
direction = \"90 deg\"

[[bodies]]
name = \"stem\"
on = \"stem\"
cylinder = { radius = \"15 mm\", from = \"40 mm\", to = \"150 mm\" }

[[obstacles]]
name = \"post\"
box = { size = [\"100 mm\", \"100 mm\", \"400 mm\"] }
position = [\"600 mm\", 0, 0]
";

/// The lines of a ply that is cut say which cups hold and why the others do not, how far array and ply are apart, and how the warp
/// and the drawing lie on the mold.
#[test]
fn what_is_said_of_a_cut_ply_names_cups_and_headings() {
    let output = check(CUT, &[]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let shown = one_line(&output.stdout);
    for expected in [
        "19 of 28 cups of the array hold",
        "4 beside the ply (g6_0, g6_1, g6_2, g6_3)",
        "1 over a hole (g2_1)",
        "4 only partly on the ply (g0_0, g0_1, g0_2, g0_3)",
        "the array's middle is (10, 0) mm from that of the ply",
        "warp heading 90 deg, the drawing's x axis 45 deg",
    ] {
        assert!(shown.contains(expected), "{expected}: {shown}");
    }
    let masked = CUT.replace(
        "partly = \"leave-off\"",
        "partly = \"leave-off\", holds = [\".####..\", \".#..##.\", \".####..\", \".####..\"]",
    );
    let shown = one_line(&check(&masked, &[]).stdout);
    assert!(shown.contains("switched off by `holds`"), "{shown}");
}

/// The page of a scene has no verdict and no limit, says what the terminal says, and has a folder of its own; a plybook has none.
#[test]
fn a_page_shows_a_scene_before_it_is_draped() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    // along the yarns and coarse: it is hung in a moment
    let scene = CUT.replace("warp = \"45 deg\"", "warp = \"0 deg\"");
    std::fs::write(&file, format!("{scene}[sheet]\nmesh = \"40 mm\"\n")).unwrap();
    let output = command().arg("check").arg("--html").arg(&file).output().unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let page = std::fs::read_to_string(folder.path().join("scene.check/check.html")).unwrap();
    let data =
        page.split_once("id=\"plydrape-data\">").unwrap().1.split_once("</script>").unwrap().0;
    let data: serde_json::Value = serde_json::from_str(data).unwrap();
    assert_eq!(data["limits"], serde_json::json!([]));
    let look = &data["look"];
    let count = |key: &str| look[key].as_array().unwrap().len();
    assert_eq!((count("targets"), count("off"), count("outline"), count("warp")), (19, 9, 2, 4));
    let warned = one_line(&output.stderr);
    for note in data["left_out"].as_array().unwrap() {
        let note = note.as_str().unwrap().trim_end_matches('.');
        assert!(warned.contains(&note[1..]), "{note}: {warned}");
    }
    let shown = one_line(&output.stdout);
    for fact in data["facts"].as_array().unwrap().iter().skip(2) {
        assert!(shown.contains(fact["value"].as_str().unwrap().trim()), "{fact}");
    }

    // the folder is this command's own, and a page that somebody changed stays
    std::fs::write(folder.path().join("scene.check/check.html"), "mine").unwrap();
    let again = command().arg("check").arg("--html").arg(&file).output().unwrap();
    assert_eq!(again.status.code(), Some(2), "{}", text(&again.stdout));
    let kept = std::fs::read_to_string(folder.path().join("scene.check/check.html")).unwrap();
    assert_eq!(kept, "mine");
}

/// A sheet of some 28 000 nodes hangs for long: a signal ends the drape, because nothing is being written yet.
#[cfg(unix)]
#[test]
fn a_signal_ends_the_drape_of_a_page() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, format!("{CUT}[sheet]\nmesh = \"4 mm\"\n")).unwrap();
    let mut check = command();
    let mut child = check.args(["-q", "check", "--html"]).arg(&file).spawn().unwrap();
    let out = folder.path().join("scene.check");
    while !out.exists() {
        assert_eq!(child.try_wait().unwrap(), None, "it ended before it claimed its folder");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert!(Command::new("kill").arg(child.id().to_string()).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(!out.join("check.html").exists());
}

/// Fabric far beyond the cups on a mold that sticks, rows of cups that make a fine mesh, an obstacle in the mold, bodies that meet
/// something at the start, and limits that no plan keeps are warned of; each warning is gone without its cause.
#[test]
fn what_a_plan_will_meet_is_warned_of() {
    let lamp = "[[obstacles]]\nname = \"lamp\"\n\
        box = { size = [\"300 mm\", \"300 mm\", \"100 mm\"] }\nposition = [0, 0, \"200 mm\"]\n";
    let scene = format!("{CUT}{lamp}[limits]\nposition = \"2 mm\"\ntilt = \"1 deg\"\n");
    let warned = |scene: &str| {
        let output = check(scene, &[]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        one_line(&output.stderr)
    };
    let all = warned(&scene);
    let causes = [
        ("stick short of their places", "[limits]", "[contact]\nfriction = 0.3\n[limits]"),
        ("the cups are in so many rows", "warp = \"45 deg\"", "warp = \"0 deg\""),
        (
            "obstacle post reaches 200 mm into the mold",
            "[\"600 mm\", 0, 0]",
            "[\"2 m\", 0, \"2 m\"]",
        ),
        ("at the start", "[0, 0, \"200 mm\"]", "[0, 0, \"800 mm\"]"),
        ("no plan can keep this limit: tilt", "tilt = \"1 deg\"", "tilt = \"40 deg\""),
    ];
    for (words, cause, without) in causes {
        assert!(all.contains(words), "{words}: {all}");
        assert!(scene.contains(cause));
        let left = warned(&scene.replace(cause, without));
        assert!(!left.contains(words), "{words}: {left}");
    }
    let lower = warned(&scene.replace("[0, 0, \"200 mm\"]", "[0, 0, \"60 mm\"]"));
    for (warnings, inside) in [(&all, false), (&lower, true)] {
        assert_eq!(warnings.contains("starts inside obstacle lamp"), inside, "{warnings}");
    }
}

/// An edge beyond the outer cups is warned of from the length on that the warning allows, and not where the ply can slide. A pad holds of
/// a corner what it covers of its diagonal.
#[test]
fn an_edge_that_hangs_too_low_is_warned_of_with_the_length_that_may_hang() {
    let scene = in_unit("mm").replace("\"catenaries\"", "\"sheet\"");
    let material = scene.lines().find(|line| line.starts_with("material")).expect("a material");
    let edge = |mm: f64| {
        scene.replace(material, &format!("material = \"prepreg_warm\"\noverhang = \"{mm} mm\""))
    };
    let warned = warning(&edge(25.0));
    let words = warned.split("what an edge of ").nth(1).expect(&warned);
    let most: f64 = words.split(' ').next().unwrap().parse().unwrap();
    assert!((5.0..25.0).contains(&most), "{warned}");
    // a lip far stiffer than the ply holds as much as a pad, and one far limper nothing
    let lip = |rigidity: &str| format!("lip = {{ radius = \"15 mm\", rigidity = \"{rigidity}\" }}");
    let held_by =
        [("pad_radius = \"15 mm\"".into(), 15.0), (lip("0.1 N m"), 15.0), (lip("1e-8 N m"), 0.0)];
    for (held, radius) in held_by {
        let warned = warning(&edge(35.0).replace("[grippers]", &format!("[grippers]\n{held}")));
        let words = warned.split("what an edge of ").nth(1).expect(&warned);
        let with_pads: f64 = words.split(' ').next().unwrap().parse().unwrap();
        assert!((with_pads - most - radius / 2.0_f64.sqrt()).abs() < 0.15, "{most} {with_pads}");
    }
    assert_eq!(warnings(&edge(0.98 * most)), [""; 0]);
    assert_eq!(warnings(&edge(1.02 * most)).len(), 1);
    assert_eq!(warnings(&format!("{}\n[contact]\nfriction = 0.3\n", edge(25.0))), [""; 0]);
}

/// The line of a table `[release]` says the order and the dwell; without the table there is none.
#[test]
fn the_line_of_a_release_says_which_pads_let_go_when() {
    let scene = in_unit("mm").replace("\"catenaries\"", "\"sheet\"");
    // the sheet needs bending rigidity, shear and tension
    let material = scene.lines().find(|line| line.starts_with("material")).expect("a material");
    let scene = scene.replace(material, "material = \"krogh2018\"");
    let line = |release: &str| {
        let output = check(&format!("{scene}{release}"), &[]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let shown = text(&output.stdout);
        let found = shown.lines().find_map(|line| line.strip_prefix("  release   "));
        found.map(str::to_string)
    };
    let ends = "; the verdict is that of the ply without pads";
    assert_eq!(line(""), None);
    for (table, expected) in [
        ("[release]\n", "all pads let go as the motion ends"),
        (
            "[release]\ndwell = \"500 ms\"\n",
            "all pads press for 0.5 s after the motion and then let go",
        ),
        (
            "[release]\norder = \"hollows-first\"\n",
            "each pad over a hollow lets go as its gripper comes to its last place, the others as the motion ends",
        ),
        (
            "[release]\norder = \"hollows-first\"\ndwell = \"2 s\"\n",
            "each pad over a hollow lets go 2 s after its gripper comes to its last place; the others press for 2 s after the motion",
        ),
    ] {
        assert_eq!(line(table), Some(format!("{expected}{ends}")));
    }
}

/// 0.3143 kg/m each 100 mm are 3.14 kg/m², ten plies of prepreg of 0.3143 kg/m²; cells of another size make it another number, and a
/// mass per area says itself what it weighs.
#[test]
fn a_mass_per_line_is_shown_per_area_in_the_cells_of_the_scene() {
    let shown = |cell: &str, material: &str| {
        let scene = format!(
            "[ply]\ngrippers = [4, 2]\ncell = [{cell}]\nmaterial = \"{material}\"\n\
             [mold]\nkind = \"plane\"\n[target]\n"
        );
        let output = check(&scene, &[]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        one_line(&output.stdout)
    };
    for (cell, expected) in [
        (
            "0.1, 0.1",
            "0.3143 kg/m over cells of 100 × 100 mm are 3.14 kg/m², the weight of 10 plies of prepreg of 0.3143 kg/m²",
        ),
        (
            "0.15, 0.25",
            "0.3143 kg/m over cells of 150 × 250 mm are 1.57 kg/m², the weight of 5 plies of prepreg of 0.3143 kg/m²",
        ),
        ("1.0, 1.0", "0.3143 kg/m over cells of 1000 × 1000 mm are 0.31 kg/m² scatter"),
    ] {
        let shown = shown(cell, "krogh2018");
        assert!(shown.contains(expected), "{expected}\n{shown}");
        assert!(shown.contains("ASSUMED, not measured: a shear slope of 5 N/m per rad"), "{shown}");
    }
    assert!(!shown("0.1, 0.1", "prepreg_cold").contains("over cells"));
}

/// Shares and factors are in one line; what nobody says is not in it.
#[test]
fn the_scatter_of_a_material_is_shown() {
    let line = |scatter: &str| {
        let scene = in_unit("mm")
            .replace("bending_rigidity_weft = 0", &format!("bending_rigidity_weft = 0{scatter}"));
        let output = check(&scene, &[]);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        let shown = text(&output.stdout);
        shown.lines().find_map(|line| line.trim().strip_prefix("scatter: ")).map(str::to_string)
    };
    assert_eq!(line(""), None);
    for (scatter, expected) in [
        (
            "mass = \"5 %\", bending_rigidity_warp = 0.3, bending_rigidity_weft = 0.3, shear_curve = { factor = 2 }",
            "mass 5 %, bending 30 %, shear a factor of 2",
        ),
        ("bending_rigidity_weft = 0.2, shear_curve = \"8 %\"", "bending in weft 20 %, shear 8 %"),
    ] {
        assert_eq!(line(&format!(", scatter = {{ {scatter} }}")).as_deref(), Some(expected));
    }
}

/// The warnings about a scene that passes.
fn warnings(scene: &str) -> Vec<String> {
    let output = check(scene, &[]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stderr)
        .lines()
        .map(|line| line.strip_prefix("warning: ").expect(line).to_string())
        .collect()
}

/// The one warning about it.
fn warning(scene: &str) -> String {
    let found = warnings(scene);
    assert_eq!(found.len(), 1, "{found:?}");
    found.into_iter().next().unwrap()
}

fn in_unit(unit: &str) -> String {
    SCENE.replace("LL", unit)
}

/// The start as the keys say, the target as the fabric is; of all ways that of gripper g0_1 is the longest, from
/// (10, 78, 75) to (0, 100, 0) mm.
#[test]
fn start_and_target_are_shown_in_x_y_z_with_the_longest_way() {
    let output = check(&in_unit("mm"), &[]);
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    let shown = one_line(&output.stdout);
    for line in [
        "start x 10 to 304 mm, y -20 to 78 mm, z 75 mm, middle (157, 29, 75) mm",
        "x 0 to 300 mm, y 0 to 100 mm, z 0 mm, middle (150, 50, 0) mm",
    ] {
        assert!(shown.contains(line), "{shown}");
    }
    let way = (10f64 * 10.0 + 22.0 * 22.0 + 75.0 * 75.0).sqrt();
    let line = format!("way {way:.4} mm in a straight line at most, of gripper g0_1");
    assert!(shown.contains(&line), "{line}\n{shown}");
}

/// A held ply without a target has a start and no way.
#[test]
fn a_held_ply_has_no_way() {
    let scene = in_unit("mm").replace("[target]\n", "[motion]\nkind = \"hold\"\n");
    let shown = one_line(&check(&scene, &[]).stdout);
    assert!(shown.contains("start x 10 to 304 mm"), "{shown}");
    assert!(shown.contains("target none"), "{shown}");
    assert!(!shown.contains("straight line"), "{shown}");
}

/// A ply that would hang into the mold at the start is warned of with how much higher a plan begins, and is not if it is raised by that.
#[test]
fn a_start_at_which_the_ply_hangs_into_the_mold_is_warned_of() {
    let starting = |height: f64| {
        let inline =
            "{ mass = \"314 g/m^2\", bending_rigidity_warp = 0, bending_rigidity_weft = 0 }";
        in_unit("mm")
            .replace("[model]\nkind = \"catenaries\"\n", "")
            .replace(inline, "\"prepreg_warm\"")
            .replace("height = \"75 mm\"", &format!("height = \"{height} mm\""))
    };
    let low = warning(&starting(5.0));
    let (_, raise) = low.split_once("a plan starts ").unwrap();
    let (raise, _) = raise.split_once(" mm higher").unwrap();
    assert!(low.starts_with("at its start the ply would hang "), "{low}");
    assert_eq!(warnings(&starting(5.0 + raise.parse::<f64>().unwrap())), [""; 0]);
}

/// Nineteen diagonals are a long way, twenty-one a slip, in a cell of micrometers as in one of meters.
#[test]
fn a_start_many_plies_off_is_warned_of_at_any_scale() {
    // diagonal of 3 × 1 cells of 100
    let diagonal = 100.0 * 10f64.sqrt();
    for unit in ["um", "mm", "cm"] {
        let text =
            |share: f64| in_unit(unit).replace("\"10 ", &format!("\"{} ", -share * diagonal));
        let near = warnings(&text(19.0));
        assert!(near.is_empty(), "{unit}: {near:?}");
        let far = warning(&text(21.0));
        assert!(far.contains("gripper g3_1 starts") && far.contains("21 times"), "{far}");
    }
    let kilometers = warning(&in_unit("mm").replace("\"10 mm\"", "\"5000 m\""));
    assert!(kilometers.contains("5000 m from its target"), "{kilometers}");
}

/// 370 kg/m² are a slip also where the unit is written; a line of the same mass counts as a strip one cell wide.
#[test]
fn a_mass_that_no_ply_has_is_warned_of_with_the_likely_unit() {
    let areal = |mass: &str| in_unit("mm").replace("\"314 g/m^2\"", mass);
    for sound in ["0.05", "10", "\"314 g/m^2\""] {
        assert!(warnings(&areal(sound)).is_empty(), "{sound}");
    }
    let heavy = warning(&areal("\"370 kg/m^2\""));
    assert!(heavy.contains("370 kg/m²") && heavy.contains("did you mean mass = \"370 g/m^2\"?"));
    let light = warning(&areal("\"314 mg/m^2\""));
    assert!(light.contains("less than plies have"), "{light}");

    let line = |mass: &str| {
        let material = format!("material = {{ mass = {mass}, flexural_rigidity = 0 }}\n");
        let lines = in_unit("mm");
        lines
            .lines()
            .map(|l| if l.starts_with("material") { material.clone() } else { format!("{l}\n") })
            .collect::<String>()
    };
    // 0.1 m wide: ten times as much per area
    for sound in ["\"5.1 g/m\"", "\"0.99 kg/m\""] {
        assert!(warnings(&line(sound)).is_empty(), "{sound}");
    }
    let heavy = warning(&line("\"37 kg/m\""));
    assert!(heavy.contains("makes 370 kg/m²") && heavy.contains("\"37 g/m\""), "{heavy}");
    assert!(warning(&line("\"4.9 g/m\"")).contains("0.049 kg/m²"));
}

/// A roof, ridge downwards, is flat from above; turned over it is a mold, and no side of it is in doubt.
#[test]
fn a_mold_that_seems_to_be_upside_down_is_warned_of() {
    let folder = tempfile::tempdir().unwrap();
    let corners = "v 0 0 0\nv 400 0 0\nv 400 400 0\nv 0 400 0\nv 0 200 -50\nv 400 200 -50\n";
    let roof = "f 1 2 3 4\nf 1 5 6 2\nf 4 3 6 5\nf 1 4 5\nf 2 6 3\n";
    // clockwise from above
    let sheet = "f 1 4 3 2\n";
    let warned = |name: &str, faces: &str, more: &str| {
        let file = folder.path().join(name);
        std::fs::write(&file, format!("{corners}{faces}")).unwrap();
        let mold = format!(
            "[mold]\nkind = \"mesh\"\nfile = '{}'\nunit = \"mm\"\n{more}\n[grippers]",
            file.display()
        );
        warnings(&format!(
            "[ply]\ngrippers = [2, 1]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n{mold}\nspacing = [0.098, 0.098]\nheight = 0.2\n\
             origin = [0.1, 0.2]\n"
        ))
    };
    let turn = "rotation = [\"180 deg\", 0, 0]\nposition = [0, 0.4, 0]";
    let solid = warned("roof.obj", roof, "");
    assert!(
        solid.len() == 1 && solid[0].contains("flat from above and shaped from below"),
        "{solid:?}"
    );
    assert!(solid[0].contains("rotation = [\"180 deg\", 0, 0] in [mold]"), "{solid:?}");
    assert_eq!(warned("turned.obj", roof, turn), Vec::<String>::new());
    let open = warned("sheet.obj", sheet, "");
    assert!(open.len() == 1 && open[0].contains("triangles of the mold face down"), "{open:?}");
    assert_eq!(warned("turned_sheet.obj", sheet, turn), Vec::<String>::new());
}

/// Each once: of a target in the mold the steps before it are not reported as well.
#[test]
fn grippers_below_the_mold_are_warned_of_once() {
    let target = |z: &str| {
        let row = |y: f64| {
            let places: Vec<String> =
                (0..4).map(|i| format!("[{}, {y}, \"{z}\"]", 0.1 * f64::from(i))).collect();
            format!("[{}]", places.join(", "))
        };
        in_unit("mm") + &format!("positions = [{}, {}]\n", row(0.0), row(0.1))
    };
    assert!(warnings(&target("-0.19 mm")).is_empty());
    let deep = warning(&target("-139 mm"));
    assert!(deep.contains("lies 139 mm below the mold"), "{deep}");
    assert!(deep.contains("limits.penetration allows 0.2 mm"), "{deep}");
    // allowed, and no plan ends there all the same
    let allowed = warning(&(target("-139 mm") + "[limits]\npenetration = \"140 mm\"\n"));
    assert!(allowed.contains("no plan can keep this limit: off mold"), "{allowed}");
}

/// Down to 20 mm below the mold and back up: the end says nothing of it.
#[test]
fn a_motion_through_the_mold_is_warned_of_with_its_step() {
    let folder = tempfile::tempdir().unwrap();
    let mut rows = "t (s),gripper,x (mm),y (mm),z (mm)\n".to_string();
    for (t, z) in [(0, 75), (1, -20), (2, 1)] {
        rows += &format!("{t},0-0,0,0,{z}\n{t},1-0,98,0,{z}\n");
    }
    std::fs::write(folder.path().join("way.csv"), rows).unwrap();
    let scene = folder.path().join("scene.toml");
    let ply = "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 1]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n[mold]\nkind = \"plane\"\n";
    std::fs::write(&scene, format!("{ply}[motion]\nkind = \"file\"\nfile = \"way.csv\"\n"))
        .unwrap();
    let output = command().arg("check").arg("--quiet").arg(&scene).output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(output.stdout.is_empty());
    let message = text(&output.stderr);
    assert!(
        message.contains("in step 2 gripper") && message.contains("is 20 mm below the mold"),
        "{message}"
    );
    assert_eq!(message.lines().count(), 1, "{message}");
}

/// The duration of a straight motion is kept by the simulation and refused by the plan, with the key that it keeps.
#[test]
fn a_duration_that_a_plan_would_ignore_is_refused_by_it() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    let motion = "\n[motion]\nkind = \"straight\"\nsteps = 3\nduration = \"20 s\"\n";
    std::fs::write(&scene, in_unit("mm") + motion).unwrap();
    let shown = one_line(&command().arg("check").arg(&scene).output().unwrap().stdout);
    assert!(shown.contains("motion 3 steps in 20 s"), "{shown}");

    let output = command().arg("plan").arg(&scene).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let message = one_line(&output.stderr);
    for part in [
        "duration \"20 s\" of [motion]",
        "write duration = \"20 s\" in [limits]",
        "scene.toml:22:12",
    ] {
        assert!(message.contains(part), "{part}\n{message}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// The lines of a tool say where its flange is and where the scene is in the robot's world, because both go into its programs.
#[test]
fn the_lines_of_a_tool_say_where_flange_and_world_are() {
    let tool = "[tool]\naxes = [{ direction = \"z\", stroke = [\"-40 mm\", \"60 mm\"] }]\nresidual = \"2 mm\"\n\
                flange = { position = [0, 0, \"300 mm\"], rotation = [\"180 deg\", 0, 0] }\n\
                world = { position = [\"1.4 m\", 0, \"0.5 m\"], rotation = [0, 0, \"90 deg\"] }\n";
    let output = check(&format!("{}{tool}", in_unit("mm")), &[]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let shown = text(&output.stdout);
    let lines: Vec<&str> = shown.lines().skip_while(|line| !line.starts_with("  tool")).collect();
    assert!(lines[0].ends_with("deg/s²; brings grippers to within 2 mm"), "{shown}");
    assert_eq!(
        lines[1..3],
        [
            "            flange in the frame at (0, 0, 300) mm, its z along (0, 0, -1)",
            "            scene in the robot's world at (1400, 0, 500) mm, its x along (0, 1, 0)",
        ],
        "{shown}"
    );
}

/// With `--json` everything that is printed for people, and nothing else; a warning is in the object alone. A plybook has its plies.
#[test]
fn json_says_what_the_lines_say() {
    let (lines, json) = (check(CUT, &[]), check(CUT, &["--json"]));
    assert_eq!((json.status.code(), text(&json.stderr)), (Some(0), String::new()));
    let object: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    let printed = text(&lines.stdout);
    let said: Vec<&str> =
        printed.lines().skip(1).map(|line| line.get(12..).unwrap_or("")).collect();
    let nouns = object["summary"].as_array().unwrap();
    let told: Vec<&str> = nouns
        .iter()
        .flat_map(|noun| noun["lines"].as_array().unwrap())
        .map(|line| line.as_str().unwrap())
        .collect();
    assert_eq!(told, said);
    let warned = one_line(&lines.stderr);
    let warnings = object["warnings"].as_array().unwrap();
    assert!(!warnings.is_empty());
    for warning in warnings {
        assert!(warned.contains(warning.as_str().unwrap()), "{warning}: {warned}");
    }

    let book = example("15_plybook").with_file_name("plies.toml");
    let output = command().args(["check", "--json"]).arg(&book).output().unwrap();
    let object: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(object["plies"].as_array().unwrap().len(), 5);
}

/// A cell that is sheared by 20 deg on the mold, by the sheet.
const SHEARED: &str = "\
[ply]
grippers = [2, 2]
cell = [\"100 mm\", \"100 mm\"]
material = \"krogh2018\"

[mold]
kind = \"plane\"

[grippers]
spacing = [\"98 mm\", \"98 mm\"]
height = \"60 mm\"

[target]
shear = \"20 deg\"

[motion]
kind = \"straight\"
steps = 10
";

/// 5 N/m per rad are 1.745 N/m at 20 deg, and three times as much 5.236; the drape then pulls harder. Once changes nothing, and without
/// the option nothing is draped.
#[test]
fn a_factor_of_the_shear_force_says_what_it_changes() {
    let output = check(SHEARED, &["--shear-scale", "3"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let shown = one_line(&output.stdout);
    for part in [
        "shear 3 times that of the material: 5.24 N/m where the ideal drape is sheared by 20 deg, in place of 1.75",
        "the motion of the scene, draped with both: ",
        " in place of ",
    ] {
        assert!(shown.contains(part), "{part}: {shown}");
    }
    let same = one_line(&check(SHEARED, &["--shear-scale", "1"]).stdout);
    assert!(same.contains("nothing changes by a hundredth of its limit"), "{same}");
    assert!(!one_line(&check(SHEARED, &[]).stdout).contains("times that of the material"));
}

/// What is no factor, a material without a shear force, and a plybook are refused with a remedy.
#[test]
fn a_factor_that_cannot_scale_is_refused() {
    for factor in ["0", "-2", "nan", "inf", "three", "1e9", ""] {
        let output = check(SHEARED, &["--shear-scale", factor]);
        let said = one_line(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{factor}: {said}");
        let fault = format!("--shear-scale \"{factor}\" is not a positive number");
        assert!(said.contains(&fault) && said.contains("as in --shear-scale 3"), "{said}");
    }
    let free = SCENE.replace("LL", "mm");
    let said = one_line(&check(&free, &["--shear-scale", "2"]).stderr);
    assert!(said.contains("needs a shear force") && said.contains("`shear_curve`"), "{said}");
    let book = example("15_plybook").with_file_name("plies.toml");
    let output = command().args(["check", "--shear-scale", "2"]).arg(&book).output().unwrap();
    assert!(one_line(&output.stderr).contains("--shear-scale is for one scene"));
}
