//! Drawings by another program, whole and damaged; `outlines/README.md` says where they come from.

use crate::common::all_cases;
use plydrape_io::read::outline::{self, Options};
use std::f64::consts::PI;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};

const TOLERANCE: f64 = 2e-5;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/outlines")
}

/// Names of the drawings, and whether their version knows splines and ellipses.
const DRAWINGS: [(&str, bool); 5] = [
    ("R12_none.dxf", false),
    ("R2000_mm.dxf", true),
    ("R2007_m.dxf", true),
    ("R2010_inch.dxf", true),
    ("R2018_cm.dxf", true),
];

fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(folder().join(name)).unwrap()
}

/// The unit of the one drawing that does not say it.
fn options(name: &str) -> Options {
    let unit = name.contains("none").then_some(1e-3);
    let layers = Some(vec!["CUT".into(), "HOLES".into()]);
    Options { unit, layers, ..Options::new(TOLERANCE) }
}

/// A rectangle with half a disc, less a circle, a slot, two circles that were stretched or turned over, an ellipse, a spline.
#[test]
fn drawings_of_every_version_and_unit_are_the_same_ply() {
    for (name, new) in DRAWINGS {
        let ply = outline::read(&folder().join(name), &options(name))
            .unwrap_or_else(|error| panic!("{error}: {}", error.help()))
            .outline;
        assert_eq!(ply.holes().len(), if new { 6 } else { 4 }, "{name}");
        let boundary = 400.0 * 200.0 + 0.5 * PI * 100.0 * 100.0;
        let slot = 40.0 * 20.0 + PI * 100.0;
        let mut holes = PI * 400.0 + slot + PI * 150.0 + PI * 25.0;
        if new {
            holes += PI * 300.0 + PI * 625.0;
        }
        // all curves together are 1.1 m long
        let expected = 1e-6 * (boundary - holes);
        assert!(
            (ply.area() - expected).abs() < 1.1 * TOLERANCE,
            "{name}: {} {expected}",
            ply.area()
        );
        for (found, due) in ply.bounds().iter().flatten().zip([0.0, 0.0, 0.5, 0.2]) {
            assert!((found - due).abs() <= TOLERANCE, "{name}: {found} {due}");
        }
        // holes are where they were drawn
        for [x, y] in [[60.0, 50.0], [80.0, 140.0], [220.0, 150.0], [340.0, 40.0]] {
            assert!(!ply.contains([1e-3 * x, 1e-3 * y]), "{name}: {x} {y}");
        }
        assert!(!new || !ply.contains([0.15, 0.06]) && !ply.contains([0.3, 0.12]), "{name}");
    }
}

#[test]
fn a_drawing_of_an_old_version_asks_for_its_unit() {
    let error =
        outline::read(&folder().join("R12_none.dxf"), &Options::new(TOLERANCE)).unwrap_err();
    assert!(error.to_string().contains("gives no unit of length"), "{error}");
}

#[test]
fn a_file_that_is_not_there_is_refused_with_its_name() {
    let error = outline::read(&folder().join("absent.dxf"), &Options::new(TOLERANCE)).unwrap_err();
    assert!(error.to_string().contains("absent.dxf: cannot be read"), "{error}");
}

/// Each is an outline or is refused; none of them panics.
fn harmless(name: &str, cases: impl Iterator<Item = Vec<u8>>) -> [usize; 2] {
    let mut counts = [0; 2];
    for (n, case) in cases.enumerate() {
        let read =
            || outline::read_dxf(name, &case, &options(name)).map_err(|e| e.help().to_owned());
        let read = catch_unwind(read).unwrap_or_else(|_| panic!("{name}, case {n}"));
        counts[usize::from(read.is_err())] += 1;
    }
    counts
}

/// Cut after a byte, one of every 37, before the mark of the end.
#[test]
fn drawings_that_end_early_are_refused() {
    for (name, _) in DRAWINGS {
        let all = bytes(name);
        let end = all.trim_ascii_end().len();
        let cut = (0..end).step_by(37).map(|n| all[..n].to_vec());
        assert_eq!(harmless(name, cut)[0], 0, "{name}");
    }
}

/// Bits that flip here and there, and lines that become other numbers or are lost.
#[test]
fn damaged_drawings_never_panic() {
    let mut state = 1_u64;
    let mut random = move |below: usize| {
        // Knuth's linear congruential generator (MMIX)
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    for (name, _) in DRAWINGS {
        let all = bytes(name);
        let (flips, apart) = if all_cases() { (600, 1) } else { (100, 7) };
        let flipped = (0..flips).map(|_| {
            let mut bytes = all.clone();
            for _ in 0..3 {
                let at = random(bytes.len());
                bytes[at] ^= 1 << random(8);
            }
            bytes
        });
        let counts = harmless(name, flipped);
        assert!(counts.iter().all(|count| *count > 10), "{name}: {counts:?}");
        let lines: Vec<&[u8]> = all.split(|byte| *byte == b'\n').collect();
        // a prime step, so that codes and values come up
        for text in ["-1", "0", "1e300", "99999999999", "nan", "ENDSEC", ""] {
            let other = (0..lines.len()).step_by(13 * apart).map(|n| {
                let mut lines = lines.clone();
                lines[n] = text.as_bytes();
                lines.join(&b'\n')
            });
            harmless(name, other);
        }
        let lost = (0..lines.len()).step_by(11 * apart).map(|n| {
            let mut lines = lines.clone();
            lines.remove(n);
            lines.join(&b'\n')
        });
        harmless(name, lost);
    }
}
