//! Scenes that pass: the template, the examples, and the same positions written in other ways.

use plydrape::errors::{Errors, GripperErrors, Term};
use plydrape::layup::{Friction, Lip, Model, PadSettings, Settings, SheetSettings, SheetTime};
use plydrape::material::{Section, ShearCurve, TensionLaw};
use plydrape::measure::Limits;
use plydrape::measure::Name;
use plydrape::scene::Scene;
use plydrape_io::Error;
use plydrape_io::scene::{self, SceneFile};
use proptest::prelude::*;
use serde_json::Value;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn parse(text: &str) -> Result<SceneFile, Error> {
    scene::parse(text, Path::new(env!("CARGO_MANIFEST_DIR")), "scene.toml")
}

#[test]
fn the_template_passes_its_own_check() {
    let scene = parse(scene::TEMPLATE).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene.layup.ply.grid.grippers(), 12);
    assert_eq!(scene.layup.motion.positions.len(), 30);
    assert_eq!(scene.limits.most(Name::Shear), 45f64.to_radians());
}

/// A scene of `plydrape new` is planned as one of its cell whose table `[plan]` is left out.
#[test]
fn the_template_plans_as_a_scene_that_says_nothing_of_it() {
    let (before, after) = scene::TEMPLATE.split_once("[plan]").expect("a table");
    let (_, after) = after.split_once("\n[").expect("another table");
    let bare = parse(&format!("{before}[{after}")).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(parse(scene::TEMPLATE).unwrap_or_else(|e| panic!("{e}")).plan, bare.plan);
}

/// A limit that is written in the template at its usual value, "95 %" for 0.95, is the usual one, so that a scene of `plydrape new` is not
/// refused for a limit that only the other model measures.
#[test]
fn the_template_sets_no_limit_that_its_model_does_not_judge() {
    let scene = parse(scene::TEMPLATE).unwrap_or_else(|e| panic!("{e}"));
    let names = |limits: &Limits| -> Vec<Name> {
        let unjudged = limits.unjudged(&scene.layup, &[]);
        unjudged.into_iter().map(|(name, _)| name).collect()
    };
    assert_eq!(names(&scene.limits), names(&Limits::usual(&scene.layup)));
}

#[test]
fn every_example_passes_the_check() {
    let mut passed = 0;
    for folder in std::fs::read_dir(root().join("examples")).unwrap() {
        let folder = folder.unwrap().path();
        let file = folder.join("scene.toml");
        // notebooks, studies and pictures have tests of their own
        if !file.is_file() {
            continue;
        }
        let deck = root().join("../shared/data/molds/blade_like.inp");
        if file.ends_with("09_blade/scene.toml") && !deck.exists() {
            eprintln!("SKIPPED {}: no {}", file.display(), deck.display());
            continue;
        }
        scene::read(&file).unwrap_or_else(|e| panic!("{e}"));
        passed += 1;
    }
    assert!(passed >= 3, "{passed}");
}

/// Numbers of the paper's Table 1 and section 4.
#[test]
fn the_first_example_is_the_papers() {
    let scene = scene::read(&root().join("examples/01_flat_sheared_mold/scene.toml")).unwrap();
    let line = scene.layup.ply.line(plydrape::ply::Kind::EdgeU);
    assert_eq!((line.mass, scene.layup.settings.gravity), (0.3143, 9.8));
    // E·I of the table.
    assert!((line.flexural_rigidity - 1.0e8 * 9.0e-14).abs() < 1e-20);
    assert_eq!(scene.layup.motion.times.len(), 30);
    let start = &scene.layup.motion.positions[0];
    assert!((start[7][0] - 0.294).abs() < 1e-15 && (start[7][1] - 0.098).abs() < 1e-15);
    // Sides of 100 mm, v leaning 20 degrees towards u.
    let end = scene.layup.motion.positions.last().unwrap();
    let (sin, cos) = 20f64.to_radians().sin_cos();
    let corner = [0.3 + 0.1 * sin, 0.1 * cos, 0.0];
    for (found, expected) in end[7].iter().zip(corner) {
        assert!((found - expected).abs() < 1e-15, "{found} {expected}");
    }
    assert_eq!(*end, scene.layup.target.as_ref().unwrap().grippers);
}

/// The rectangle of [`START`] as spacing, as a table and in a CSV file.
#[test]
fn positions_are_the_same_however_they_are_written() {
    let with = |grippers: &str| {
        let text = format!(
            "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 2]\ncell = [\"100 mm\", 0.1]\nmaterial = \"krogh2018\"\n[grippers]\n{grippers}\n"
        );
        parse(&text).unwrap_or_else(|e| panic!("{e}")).scene.layup.motion.positions
    };
    let spacing = with("spacing = [0.098, 0.098]\nheight = 0.05\norigin = [0.01, 0]");
    let table = with(
        "positions = [[[0.01, 0, \"50 mm\"], [\"108 mm\", 0, 0.05]], [[0.01, 0.098, 0.05], [0.108, 0.098, 0.05]]]",
    );
    let file = with("positions = \"tests/it/start.csv\"");
    for (a, b) in spacing[0].iter().zip(&table[0]).chain(spacing[0].iter().zip(&file[0])) {
        for k in 0..3 {
            assert!((a[k] - b[k]).abs() < 1e-15, "{a:?} {b:?}");
        }
    }
}

/// Times count from the first row; columns that are not asked for are ignored.
#[test]
fn a_motion_file_defines_start_and_steps() {
    let text = "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 1]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n[motion]\nkind = \"file\"\nfile = \"tests/it/trajectory.csv\"\n";
    let motion = parse(text).unwrap_or_else(|e| panic!("{e}")).scene.layup.motion;
    assert_eq!(motion.times, [0.0, 0.5, 2.0]);
    assert_eq!(motion.positions[0], [[0.0, 0.0, 0.05], [0.098, 0.0, 0.05]]);
    assert_eq!(motion.positions[2][1], [0.099, 0.0, 0.02]);
}

/// Every term has the unit and the law of its key; what is left out has no error, and a scene without the table none at all.
#[test]
fn errors_are_read_term_by_term() {
    let template = scene::TEMPLATE.replace("\"usual\"", "\"ideal\"");
    let text = format!("{template}\n{ERRORS}");
    let scene = parse(&text).unwrap_or_else(|e| panic!("{e}"));
    let errors = scene.errors.expect("errors");
    let near = |term: Term, expected: Term| {
        let same = matches!(
            (term, expected),
            (Term::Deviation(_), Term::Deviation(_))
                | (Term::Bound(_), Term::Bound(_))
                | (Term::Factor(_), Term::Factor(_))
        );
        assert!(same && (term.value() - expected.value()).abs() < 1e-15, "{term:?} {expected:?}");
    };
    assert_eq!((errors.seed, errors.samples, errors.share), (3, 200, 0.9));
    near(errors.frame.position, Term::Deviation(5e-4));
    near(errors.frame.angle, Term::Bound(0.1_f64.to_radians()));
    near(errors.gripper.position, Term::Deviation(1e-4));
    near(errors.gripper.stroke, Term::Deviation(1e-4));
    near(errors.pick_up.offset, Term::Bound(1e-3));
    near(errors.pick_up.yaw, Term::Deviation(0.2_f64.to_radians()));
    near(errors.material.areal_mass, Term::Deviation(0.05));
    near(errors.material.bending, Term::Bound(0.2));
    near(errors.material.shear, Term::Factor(3.0));
    near(errors.material.length, Term::Deviation(1e-3));
    near(errors.mold.offset, Term::Deviation(6e-4));
    near(errors.mold.tilt, Term::Bound(0.05_f64.to_radians()));
    near(errors.mold.waviness, Term::Deviation(2e-4));
    assert_eq!(errors.mold.wavelength, 0.15);

    let few = format!("{template}\n[errors]\ngripper = {{ position = {{ bound = 0.001 }} }}\n");
    let errors = parse(&few).unwrap_or_else(|e| panic!("{e}")).errors.expect("errors");
    let gripper = GripperErrors { position: Term::Bound(1e-3), ..GripperErrors::default() };
    assert_eq!(errors, Errors { gripper, ..Errors::default() });
    assert_eq!((errors.samples, errors.share), (64, 0.95));
    assert!(parse(&template).unwrap_or_else(|e| panic!("{e}")).errors.is_none());
}

const ERRORS: &str = r#"
[errors]
seed = 3
samples = 200
share = "90 %"
frame = { position = { deviation = "0.5 mm" }, angle = { bound = "0.1 deg" } }
gripper = { position = { deviation = 1e-4 }, stroke = { deviation = "0.01 %" } }
pick_up = { offset = { bound = "1 mm" }, yaw = { deviation = "0.2 deg" } }
material = { areal_mass = { deviation = "5 %" }, bending = { bound = 0.2 }, shear = { factor = 3 }, length = { deviation = "0.1 %" } }

[errors.mold]
offset = { deviation = "0.6 mm" }
tilt = { bound = "0.05 deg" }
waviness = { deviation = "0.2 mm" }
wavelength = "150 mm"
"#;

/// A chord equal to its fabric is taut, not too long: 98 mm written two ways differ in the last bit.
#[test]
fn a_taut_start_is_allowed() {
    let text = "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [4, 1]\ncell = [0.098, 0.1]\nmaterial = \"krogh2018\"\n[grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = 0\n";
    assert!(parse(text).is_ok());
}

#[test]
fn an_inextensible_ply_is_written_as_infinity() {
    for stiffness in ["inf", "\"inf\"", "\"inf N\""] {
        let text = scene::TEMPLATE.replace("\"100 kN\"", stiffness);
        let scene = parse(&text).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(scene.layup.settings.axial_stiffness, f64::INFINITY);
    }
}

/// The keys of [plan] and the motion's limits, each in a unit of its own, a seed of 64 bits; what is left out
/// has the default.
#[test]
fn a_plan_and_its_limits_are_read_in_si() {
    let keys = "[plan]\nmethod = \"stepwise\"\nsteps = 40\nmove_limit = \"5 mm\"\nseed = 9223372036854775808\nrate = \"1 kHz\"\n";
    let limits = "gripper_distance = \"60 mm\"\nworkspace = [[\"-500 mm\", 1], [-1, 1], [0, 2]]\nspeed = \"6 m/min\"\n";
    let text = "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 2]\ncell = [\"100 mm\", 0.12]\nmaterial = \"krogh2018\"\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n";
    let scene = parse(&format!("{text}{keys}[limits]\n{limits}")).unwrap_or_else(|e| panic!("{e}"));
    let plan = scene.plan;
    assert_eq!(
        (plan.method, plan.steps, plan.seed),
        (plydrape::scene::PlanMethod::Stepwise, 40, 1 << 63)
    );
    assert_eq!((plan.move_limit, plan.rate, plan.evaluations), (Some(0.005), 1000.0, 100));
    let limits = &scene.limits;
    assert_eq!(limits.most(Name::GripperDistance), 0.06);
    assert_eq!(limits.workspace, Some([[-0.5, 1.0], [-1.0, 1.0], [0.0, 2.0]]));
    assert!((limits.most(Name::Speed) - 0.1).abs() < 1e-15, "{}", limits.most(Name::Speed));

    let scene = parse(text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene.plan, plydrape::scene::PlanSettings::default());
    let usual =
        parse(&format!("[cell]\npreset = \"usual\"\n{}", text.replace("catenaries", "sheet")));
    assert_eq!(usual.unwrap_or_else(|e| panic!("{e}")).plan.evaluations, 1200);
    assert_eq!((scene.limits.most(Name::GripperDistance), scene.limits.workspace), (0.05, None));
}

/// Locking angle and the test that found it go together: neither is left out in silence.
#[test]
fn a_locking_angle_has_its_test_and_a_test_its_angle() {
    let text = "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 2]\ncell = [0.1, 0.1]\nmaterial = { mass = 0.3, bending_rigidity_warp = 0, bending_rigidity_weft = 0, LOCKING }\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n";
    let read = |keys: &str| parse(&text.replace("LOCKING", keys));
    assert!(read("locking_angle = \"40 deg\", locking_test = \"picture frame\"").is_ok());
    for (alone, missing) in [
        ("locking_angle = \"40 deg\"", "locking_test"),
        ("locking_test = \"picture frame\"", "locking_angle"),
    ] {
        let Err(refused) = read(alone) else { panic!("{alone}") };
        assert!(refused.help().contains(missing), "{refused}");
    }
}

/// What a scene says nothing of follows from its ply and its contact, or from the sources that the keys name.
#[test]
fn every_limit_of_the_ply_and_the_joints_is_read_in_si_or_has_its_default() {
    let text = "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 2]\ncell = [0.1, 0.1]\nmaterial = MATERIAL\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n[contact]\ntolerance = \"1 mm\"\n";
    let bare = "{ mass = 0.3, bending_rigidity_warp = 0, bending_rigidity_weft = 0 }";
    let locking =
        bare.replace(" }", ", locking_angle = \"40 deg\", locking_test = \"picture frame\" }");
    let with = |material: &str, limits: &str| {
        let text = text.replace("MATERIAL", material);
        parse(&format!("{text}[limits]\n{limits}")).unwrap_or_else(|e| panic!("{e}")).scene.limits
    };
    let near = |found: f64, expected: f64| {
        assert!((found - expected).abs() <= 1e-15 * expected, "{found} {expected}");
    };
    let degrees = |angle: f64| angle.to_radians();

    let limits = with(bare, "");
    near(limits.most(Name::Shear), degrees(45.0));
    near(limits.most(Name::LandingShear), degrees(3.0));
    near(limits.most(Name::TiltRate), degrees(90.0));
    assert_eq!(
        [Name::Penetration, Name::Strain, Name::GripperLoad].map(|n| limits.most(n)),
        [1e-3, 0.005, 10.0]
    );
    assert_eq!([Name::GripperPull, Name::Duration].map(|n| limits.get(n)), [None; 2]);

    near(with(&locking, "").most(Name::Shear), degrees(40.0));
    near(with(&locking, "shear = \"50 deg\"").most(Name::Shear), degrees(50.0));
    for rate in [
        "\"30 deg/s\"",
        "\"30 °/s\"",
        "\"1800 deg/min\"",
        "0.5235987755982988",
        "\"0.5235987755982988 rad/s\"",
    ] {
        near(with(bare, &format!("tilt_rate = {rate}")).most(Name::TiltRate), degrees(30.0));
    }
    let given = "landing_shear = \"2 deg\"\nstrain = \"0.2 %\"\npenetration = \"3 mm\"\ngripper_load = \"500 mN\"\ngripper_pull = 4\nduration = \"2 min\"\n";
    let limits = with(bare, given);
    near(limits.most(Name::LandingShear), degrees(2.0));
    near(limits.most(Name::Strain), 0.002);
    near(limits.most(Name::Penetration), 0.003);
    let given = [Name::GripperLoad, Name::GripperPull, Name::Duration].map(|n| limits.most(n));
    assert_eq!(given, [0.5, 4.0, 120.0]);
}

/// Words for the middle are one: where they have a meaning, all of them are taken.
#[test]
fn every_word_for_the_middle_is_taken() {
    let scene = |origin: &str, seed: &str| {
        parse(&format!(
            "[ply]\ngrippers = [4, 2]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n[mold]\nkind = \"plane\"\n[grippers]\n\
             spacing = [0.098, 0.098]\nheight = 0.05\norigin = \"{origin}\"\n[target]\nseed = \"{seed}\"\n"
        ))
        .unwrap_or_else(|e| panic!("{e}"))
        .scene
    };
    let usual = scene("centered", "middle");
    for word in ["centred", "center", "centre", "middle", "centered"] {
        let other = scene(word, word);
        assert_eq!(other.layup.motion, usual.layup.motion, "{word}");
        assert_eq!(other.layup.target, usual.layup.target, "{word}");
    }
}

/// A plain number far from what is found in practice is refused; the same value with its unit is believed.
#[test]
fn a_value_with_its_unit_is_believed_where_a_plain_number_is_not() {
    let scene = |cell: &str, height: &str| {
        parse(&format!(
            "[ply]\ngrippers = [2, 1]\ncell = [{cell}, {cell}]\nmaterial = \"krogh2018\"\n[grippers]\n\
             spacing = [{cell}, {cell}]\nheight = {height}\n"
        ))
    };
    let error = scene("100", "1").unwrap_err();
    assert_eq!(error.message(), "`100` would make cells of 100 m");
    assert!(error.help().starts_with("did you mean \"100 mm\"?"), "{error}");
    assert_eq!(scene("\"100 m\"", "1").unwrap().layup.ply.cell, [100.0; 2]);
    assert!(scene("0.1", "75").unwrap_err().help().starts_with("did you mean \"75 mm\"?"));
    assert!(scene("0.1", "\"75 m\"").is_ok());
    // a table of positions is read as one is
    assert!(scene("1", "0").is_ok());
}

/// What data sheets say of one cloth, in their units: 9.26 oz/yd² are 314 g/m², and 918 mg·cm are 9e-5 N·m.
#[test]
fn a_material_is_read_from_the_units_of_its_data_sheet() {
    let section = |mass: &str, rigidity: &str| {
        let text = format!(
            "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 1]\ncell = [0.1, 0.1]\n[ply.material]\nmass = \"{mass}\"\nbending_rigidity_warp = \"{rigidity}\"\n\
             bending_rigidity_weft = 0\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n"
        );
        match parse(&text).unwrap_or_else(|e| panic!("{e}")).layup.ply.material.section {
            Section::Areal { mass, warp_rigidity, .. } => [mass, warp_rigidity],
            Section::Line { .. } => panic!("{text}"),
        }
    };
    for mass in
        ["314 gsm", "314 g/m2", "314 g/m²", "314 g/sqm", "9.26 oz/yd2", "9.26 osy", "0.314 kg/m^2"]
    {
        for rigidity in [
            "9e-5 Nm",
            "9e-5 N*m",
            "9e-5 N.m",
            "90 µN·m",
            "90 uN m",
            "918 mg cm",
            "918 mg·cm",
            "0.918 gf cm^2/cm",
        ] {
            let [found, stiff] = section(mass, rigidity);
            assert!((found - 0.314).abs() < 2e-4, "{mass}: {found}");
            assert!((stiff - 9e-5).abs() < 1e-7, "{rigidity}: {stiff}");
        }
    }
}

/// A mark at the beginning and the line ends of Windows change nothing.
#[test]
fn a_file_saved_on_windows_is_read_as_any_other() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, format!("\u{feff}{}", scene::TEMPLATE.replace('\n', "\r\n"))).unwrap();
    let read = scene::read(&file).unwrap_or_else(|e| panic!("{e}"));
    let template = parse(scene::TEMPLATE).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(read.layup.motion, template.layup.motion);
}

/// Every key of the sheet in a unit of its own.
#[test]
fn the_keys_of_the_sheet_are_read_in_si_or_have_their_defaults() {
    let scene = |ply: &str, grippers: &str, tables: &str| {
        let text = format!(
            "[ply]\ngrippers = [3, 2]\ncell = [0.1, 0.1]\n{ply}\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n{grippers}\n{tables}\n"
        );
        parse(&text).unwrap_or_else(|e| panic!("{e}")).scene
    };
    let paper = "material = \"krogh2018\"";
    let usual = scene(paper, "", "");
    assert_eq!(usual.layup.settings, Settings::default());
    assert_eq!(usual.limits, Limits::usual(&usual.layup));
    assert_eq!(usual.layup.ply.material.tension, Some(TensionLaw::Linear { stiffness: 1e6 }));
    assert_eq!(
        usual.layup.ply.material.shear_curve.as_ref().map(|c| c.force(0.2)),
        Some((1.0, 5.0))
    );

    let given = scene(
        &format!("{paper}\noverhang = \"30 mm\""),
        "pad_radius = \"1.5 cm\"\nlip = { radius = \"20 mm\", rigidity = \"2 mN m\" }\nstiffness = { lateral = \"2 N/mm\" }\n\
         slip_force = \"6 N\"\nholding_force = 15",
        "[model]\nkind = \"sheet\"\n[sheet]\nmesh = \"12.5 mm\"\ntime = \"real\"\nkeep = 40\n\
         [contact]\nfriction = 0.3\ntack = \"0.09 kPa\"\n\
         [limits]\nheight = \"1 mm\"\nout_of_plane = \"2 deg\"\nposition = \"3 mm\"\ngripper_force = \"8 N\"",
    );
    let (settings, limits) = (given.layup.settings, given.limits);
    let sheet =
        SheetSettings { mesh: Some(0.0125), overhang: 0.03, time: SheetTime::Real, keep: 40 };
    assert_eq!((settings.model, settings.sheet), (Model::Sheet, sheet));
    let pad = PadSettings {
        radius: 0.015,
        lip: Some(Lip { radius: 0.02, rigidity: 2e-3 }),
        lateral_stiffness: Some(2e3),
        axial_stiffness: None,
        slip_force: Some(6.0),
        holding_force: Some(15.0),
    };
    assert_eq!(settings.pad, pad);
    assert_eq!((settings.contact.friction, settings.contact.tack), (Friction::Coulomb(0.3), 90.0));
    let given = [Name::Height, Name::Position, Name::GripperForce].map(|n| limits.most(n));
    assert_eq!(given, [1e-3, 3e-3, 8.0]);
    assert_eq!(limits.most(Name::OutOfPlane), 2f64.to_radians());

    for (word, friction) in [
        ("\"stick\"", Friction::Stick),
        ("\"stick-for-ever\"", Friction::StickForEver),
        ("\"30 %\"", Friction::Coulomb(0.3)),
        ("0", Friction::Coulomb(0.0)),
    ] {
        let found = scene(paper, "", &format!("[contact]\nfriction = {word}"));
        assert_eq!(found.layup.settings.contact.friction, friction, "{word}");
    }
}

/// A material with the curves of its tests; catenaries need neither them nor an overhang.
#[test]
fn tension_and_shear_are_a_slope_or_a_table() {
    let material = |curves: &str, more: &str| {
        let text = format!(
            "[ply]\ngrippers = [2, 2]\ncell = [0.1, 0.1]\n[ply.material]\nmass = 3.1\nbending_rigidity_warp = 9e-5\nbending_rigidity_weft = 9e-5\n{curves}\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n{more}"
        );
        parse(&text).map(|scene| scene.scene.layup.ply.material)
    };
    let tables = "tension = { strain = [0, \"0.2 %\", 0.01], force = [0, \"1 N/mm\", 9e3] }\n\
         shear_curve = { angle = [0, \"20 deg\"], force = [0, \"10 N/m\"] }";
    let found = material(tables, "").unwrap_or_else(|e| panic!("{e}"));
    let law = TensionLaw::Table { strain: vec![0.0, 0.002, 0.01], force: vec![0.0, 1e3, 9e3] };
    assert_eq!(found.tension, Some(law));
    let slopes = "tension = \"1 kN/mm\"\nshear_curve = \"5 N/m/rad\"";
    let found = material(slopes, "").unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(found.tension, Some(TensionLaw::Linear { stiffness: 1e6 }));
    assert_eq!(found.shear_curve, Some(ShearCurve::Polynomial { coefficients: vec![5.0] }));

    assert!(material("", "").is_err());
    assert!(material("", "[model]\nkind = \"catenaries\"\n").is_ok());
}

/// The last scene that fits, and the first that does not: pads that touch the boundary, a line in the middle of a cell.
#[test]
fn pads_and_mesh_of_a_sheet_may_just_fit() {
    let fits = |overhang: &str, radius: &str, mesh: &str| {
        let text = format!(
            "[ply]\ngrippers = [3, 2]\ncell = [\"100 mm\", \"120 mm\"]\nmaterial = \"krogh2018\"\noverhang = \"{overhang} mm\"\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\npad_radius = \"{radius} mm\"\n[sheet]\nmesh = \"{mesh} mm\"\n"
        );
        parse(&text).is_ok()
    };
    assert!(fits("0", "0", "50") && !fits("0", "0", "50.1"));
    assert!(fits("15", "15", "35") && !fits("14.9", "15", "35") && !fits("15", "15", "35.1"));
    assert!(fits("60", "49", "1") && !fits("60", "50", "1"));
}

/// Where only the key of the motion is written that a plan ignores; a motion of a file or held has none.
#[test]
fn a_scene_with_a_duration_says_why_it_is_not_planned() {
    let scene = parse(scene::TEMPLATE).unwrap_or_else(|e| panic!("{e}"));
    assert!(scene.plan_refusal.is_none());
    let text = scene::TEMPLATE.replace("# duration = \"29 s\"", "duration = \"8 s\"");
    let scene = parse(&text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(scene.layup.motion.times.last(), Some(&8.0));
    let refusal = scene.plan_refusal.as_ref().expect("a plan would ignore the duration");
    let refusal = format!("{}; {}", refusal.message, refusal.help);
    assert!(refusal.contains("\"8 s\"") && refusal.contains("[limits]"), "{refusal}");
}

/// The schema prints what the reader takes where a key is left out.
#[test]
fn a_default_of_the_schema_is_what_a_scene_without_the_key_has() {
    let schema: Value = serde_json::from_str(&scene::schema()).unwrap();
    let mut compared = 0;
    for (name, table) in schema["properties"].as_object().unwrap() {
        let Some(link) = table["$ref"].as_str() else { continue };
        let keys = &schema["$defs"][link.rsplit('/').next().unwrap().replace("%20", " ")];
        for (key, about) in keys["properties"].as_object().into_iter().flatten() {
            let Some(default) = about.get("default") else { continue };
            let with = |line: &str| {
                let tables = [
                    ("ply", "grippers = [2, 2]\ncell = [0.1, 0.1]\nmaterial = \"prepreg_warm\"\n"),
                    ("mold", "kind = \"cylinder\"\nradius = 1\nposition = [0, 0, -1]\n"),
                    ("target", "seed = \"middle\"\n"),
                    ("motion", "kind = \"straight\"\n"),
                    ("grippers", "spacing = [0.098, 0.098]\nheight = 0.1\norigin = \"centered\"\n"),
                ];
                let own = match name.as_str() {
                    "pick_up" => "height = 0\n",
                    "robot" => "arm = \"ur20\"\n",
                    _ => "",
                };
                let mut text = String::new();
                for (table, lines) in tables {
                    let line = if table == name { line } else { "" };
                    text += &format!("[{table}]\n{lines}{line}\n");
                }
                if name == "robot" {
                    text += "[tool]\n";
                }
                if tables.iter().all(|(table, _)| table != name) {
                    text += &format!("[{name}]\n{own}{line}\n");
                }
                match parse(&text) {
                    Ok(file) => format!("{:?}", file.scene),
                    Err(fault) => panic!("{name}.{key}: {fault}\n{text}"),
                }
            };
            let (set, left_out) = (with(&format!("{key} = {default}")), with(""));
            let parts =
                |text: &str| text.split([' ', ',', '[', ']', '(', ')']).map(String::from).collect();
            let [set, left_out]: [Vec<String>; 2] = [parts(&set), parts(&left_out)];
            assert_eq!(set.len(), left_out.len(), "{name}.{key}");
            for (a, b) in set.iter().zip(&left_out).filter(|(a, b)| a != b) {
                // a unit costs the last digit
                let [a, b]: [f64; 2] = [a, b].map(|n| n.parse().unwrap_or(f64::NAN));
                assert!((a / b - 1.0).abs() < 1e-12, "{name}.{key}: {a}, {b}");
            }
            compared += 1;
        }
    }
    assert!(compared > 30, "{compared}");
}

/// `docs/scene.schema.json` is what the program prints; `UPDATE_SCHEMA=1` writes it anew.
#[test]
fn the_committed_schema_is_current() {
    let file = root().join("docs/scene.schema.json");
    if std::env::var_os("UPDATE_SCHEMA").is_some() {
        std::fs::write(&file, scene::schema()).unwrap();
    }
    assert_eq!(std::fs::read_to_string(&file).unwrap(), scene::schema());
}

/// Positions, times and settings of a scene that passed are finite.
fn assert_finite(scene: &Scene) {
    assert!(scene.layup.motion.times.iter().all(|t| t.is_finite()));
    assert!(scene.layup.motion.times.windows(2).all(|pair| pair[0] < pair[1]));
    assert!(scene.layup.motion.positions.iter().flatten().flatten().all(|x| x.is_finite()));
    assert!(scene.layup.ply.cell.iter().all(|x| x.is_finite() && *x > 0.0));
    assert!(!scene.layup.settings.axial_stiffness.is_nan() && scene.layup.settings.gravity > 0.0);
}

/// Values a careless or hostile hand might put in the place of another.
const VALUES: [&str; 20] = [
    "nan",
    "inf",
    "-inf",
    "0",
    "-1",
    "1e308",
    "1e-308",
    "\"98 kg\"",
    "\"\"",
    "[]",
    "{}",
    "true",
    "1979-05-27",
    "\"-5 deg\"",
    "[[[1, 2, 3]]]",
    "9223372036854775807",
    "\"1e999 m\"",
    "\"98 mm\"",
    "[\"98 mm\", 0]",
    "\"µ\"",
];

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// Flipped bytes and lost lines are read or refused with a place inside the text.
    #[test]
    fn a_damaged_scene_is_read_or_refused(
        flips in prop::collection::vec((0..scene::TEMPLATE.len(), any::<u8>()), 0..6),
        lost in prop::collection::vec(0..110usize, 0..4),
    ) {
        let mut bytes = scene::TEMPLATE.as_bytes().to_vec();
        for (at, byte) in flips {
            bytes[at] = byte;
        }
        let text = String::from_utf8_lossy(&bytes);
        let kept: Vec<&str> = text.lines().enumerate().filter(|(k, _)| !lost.contains(k)).map(|(_, l)| l).collect();
        let text = kept.join("\n");
        match parse(&text) {
            Ok(scene) => assert_finite(&scene),
            Err(error) => {
                prop_assert!(!error.message().is_empty() && !error.help().is_empty());
                if let Some(span) = error.diagnostic().unwrap().span.clone() {
                    prop_assert!(error.diagnostic().unwrap().text.get(span).is_some());
                }
            }
        }
    }

    /// A value in the place of another is read or refused.
    #[test]
    fn a_strange_value_is_read_or_refused(line in 0..110usize, value in 0..VALUES.len(), twice in 0..110usize) {
        let text: Vec<String> = scene::TEMPLATE.lines().enumerate().map(|(k, l)| {
            let l = l.trim_start_matches("# ");
            match l.split_once(" = ") {
                Some((key, _)) if k == line || k == twice => format!("{key} = {}", VALUES[value]),
                _ => scene::TEMPLATE.lines().nth(k).unwrap_or_default().to_string(),
            }
        }).collect();
        if let Ok(scene) = parse(&text.join("\n")) {
            assert_finite(&scene);
        }
    }
}
