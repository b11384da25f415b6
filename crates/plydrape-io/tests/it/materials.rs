//! The materials that come with the program: they say where their numbers come from, how far these may be off, and they have the size
//! of the plies that they stand for.

use crate::common::parse;
use plydrape::material::{Material, Scatter, Section, Spread};
use plydrape::ply::{Grid, Ply};
use plydrape_io::scene::{read_material, shipped_material, shipped_materials};
use std::path::Path;

fn shipped(name: &str) -> Material {
    read_material(name).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Shear force per length (N/m) at 20°.
fn at_20_degrees(name: &str) -> f64 {
    shipped(name).shear_curve.expect("a shear curve").force(20.0_f64.to_radians()).0
}

/// A name that is listed is that of its file, and no file is left out.
#[test]
fn every_material_file_is_shipped_under_its_name() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("materials");
    let mut files: Vec<String> = std::fs::read_dir(folder)
        .expect("the folder")
        .map(|entry| entry.expect("a file").path().file_stem().unwrap().to_string_lossy().into())
        .collect();
    let mut names: Vec<String> = shipped_materials().map(String::from).collect();
    files.sort();
    names.sort();
    assert_eq!(files, names);
    for name in names {
        assert_eq!(shipped(&name).name, name);
    }
}

/// Measured values are called so in the source, and so are those that nobody measured. All of them are assumed in part.
#[test]
fn every_shipped_material_says_what_of_it_is_assumed() {
    for name in shipped_materials() {
        let source = shipped(name).source;
        assert!(source.contains("ASSUMED"), "{name}: {source}");
        assert!(source.contains("scatter for plans ASSUMED"), "{name}: {source}");
        let assumed = source.split("ASSUMED").nth(1).expect("what is assumed");
        let curve = shipped_material(name).expect("its file");
        if curve.contains("shear_curve = \"5 N/m\"") {
            assert!(assumed.contains("shear slope of 5 N/m per rad"), "{name}: {source}");
        }
    }
}

/// 5 % of the mass, 30 % of the bending, and a factor for the shear: 2 where both tests of the fabric are published, else 3.
#[test]
fn every_shipped_material_has_the_scatter_of_a_plan() {
    for name in shipped_materials() {
        let material = shipped(name);
        let areal = matches!(material.section, Section::Areal { .. });
        let factor = if name.starts_with("cao2008_plain") { 2.0 } else { 3.0 };
        let expected = Scatter {
            mass: Some(0.05),
            warp_rigidity: Some(0.3),
            weft_rigidity: areal.then_some(0.3),
            tension: None,
            shear_curve: Some(Spread::Factor { factor }),
        };
        assert_eq!(material.scatter, expected, "{name}");
    }
}

/// The forces at 20° are those of Cao et al. 2008 along the yarns, times the cosine, and the ranges that are assumed for prepreg.
#[test]
fn shear_forces_at_20_degrees_are_those_that_the_sources_name() {
    let cosine = 20.0_f64.to_radians().cos();
    for (name, [low, nominal, high]) in [
        ("cao2008_plain", [6.0, 8.5, 11.0].map(|force| force * cosine)),
        ("cao2008_plain_frame", [17.0, 28.0, 44.0].map(|force| force * cosine)),
        ("dry_carbon", [6.0, 8.5, 11.0].map(|force| force * cosine)),
        ("prepreg_cold", [20.0, 28.3, 40.0]),
        ("prepreg_warm", [5.0, 7.07, 10.0]),
    ] {
        let force = at_20_degrees(name);
        assert!((low..=high).contains(&force), "{name}: {force}");
        // slopes and tables have two digits
        assert!((force / nominal - 1.0).abs() < 0.015, "{name}: {force} {nominal}");
    }
    assert!(at_20_degrees("krogh2018") < 0.4 * at_20_degrees("prepreg_warm"));
}

/// Only the force at 20° is known of the picture frames; the shape is that of bias extension.
#[test]
fn the_curve_of_the_frame_is_that_of_bias_extension_times_28_over_8_5() {
    let curve = |name| shipped(name).shear_curve.expect("a shear curve");
    let (bias, frame) = (curve("cao2008_plain"), curve("cao2008_plain_frame"));
    for degrees in [2.0_f64, 5.0, 10.0, 17.0, 30.0, 40.0, 50.0] {
        let [bias, frame] = [&bias, &frame].map(|curve| curve.force(degrees.to_radians()).0);
        // forces of the tables have two decimals
        assert!((frame - 28.0 / 8.5 * bias).abs() < 0.03, "{degrees}: {frame} {bias}");
    }
}

/// Bending lengths (D′/weight)^(1/3) of the middle eight in ten of 618 measured fabrics are from 12 to 31 mm.
#[test]
fn the_three_plies_to_plan_for_bend_and_weigh_as_real_ones() {
    for name in ["dry_carbon", "prepreg_cold", "prepreg_warm"] {
        let Section::Areal { mass, warp_rigidity, .. } = shipped(name).section else {
            panic!("{name} is given by line")
        };
        assert!((0.2..=0.6).contains(&mass), "{name}: {mass}");
        let length = (warp_rigidity / (mass * 9.81)).cbrt();
        assert!((0.012..=0.031).contains(&length), "{name}: {length}");
    }
}

/// A line of 0.3143 kg/m each 0.1 m are 3.143 kg/m², ten times what `prepreg_cold` weighs.
#[test]
fn the_paper_s_lines_over_cells_of_100_mm_weigh_as_ten_plies() {
    let weighs =
        |name: &str, cell| Ply::of_array(Grid { nu: 4, nv: 2 }, cell, shipped(name)).areal_mass();
    let real = weighs("prepreg_cold", [0.1, 0.1]);
    assert!((weighs("krogh2018", [0.1, 0.1]) / real - 10.0).abs() < 1e-9);
    // along u a line for every 0.15 m, along v one for every 0.05 m: on average one for every 0.1 m
    assert!((weighs("krogh2018", [0.05, 0.15]) / real - 10.0).abs() < 1e-9);
    assert!((weighs("krogh2018", [0.2, 0.2]) / real - 5.0).abs() < 1e-9);
}

/// A share is a number in a result, a factor a table with its key, and both are read back.
#[test]
fn a_scatter_of_the_shear_is_a_share_or_a_factor_in_a_result() {
    for (spread, json) in
        [(Spread::Share(0.26), "0.26"), (Spread::Factor { factor: 2.0 }, "{\"factor\":2.0}")]
    {
        let scatter = Scatter { shear_curve: Some(spread), ..Scatter::default() };
        let written = serde_json::to_string(&scatter).expect("JSON");
        assert!(written.contains(&format!("\"shear_curve\":{json}")), "{written}");
        assert_eq!(serde_json::from_str::<Scatter>(&written).expect("a scatter"), scatter);
    }
}

/// What resin adds is read in SI units; the ply has the lowest temperature of its table, or that of the scene, between the two.
#[test]
fn the_resin_of_a_ply_relaxes_at_its_temperature() {
    let ply = |temperature: &str, relaxation: &str| {
        let text = format!(
            "[ply]\ngrippers = [2, 2]\ncell = [0.1, 0.1]\n{temperature}\nmaterial = {{ mass = 0.3, bending_rigidity_warp = 1e-5, \
             bending_rigidity_weft = 1e-5, tension = 1e6, shear_curve = 5, shear_rate = {{ stiffness = \"150 N/m\", relaxation = {relaxation} }} }}\n\
             [grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n"
        );
        parse(&text).layup.ply.material.shear_rate.expect("resin")
    };
    let near = |found: f64, expected: f64| {
        assert!((found / expected - 1.0).abs() < 1e-12, "{found} {expected}");
    };
    let one = ply("", "\"800 ms\"");
    near(one.stiffness, 150.0);
    near(one.time(), 0.8);

    let table = "{ temperature = [\"25 degC\", \"333.15 K\"], time = [\"0.8 s\", \"32 ms\"] }";
    near(ply("", table).time(), 0.8);
    near(ply("temperature = \"60 °C\"", table).time(), 0.032);
    // half-way between the inverse temperatures the time is the geometric mean
    let middle = 2.0 / (1.0 / 298.15 + 1.0 / 333.15);
    near(ply(&format!("temperature = {middle}"), table).time(), (0.8_f64 * 0.032).sqrt());
}
