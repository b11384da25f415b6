//! What plies, grippers and cells physically measure, and which plain numbers are believed.
//!
//! A plain number is in SI units, and whoever leaves out a unit often thinks of another one: `cell = [100, 100]` would be cells of
//! 100 m. So a plain number that is more than [`MARGIN`] away from what is found in practice is refused, with the unit in which it
//! would make sense. A value whose unit is written out is believed: `"100 m"` is 100 m.

use super::quantity::Measure;
use super::units::{self, Dimension};
use plydrape::measure::Practice;

/// How far a plain number may be outside of what is found in practice: ten times to either side. Units that are taken for each
/// other differ by a thousand, so that the margin can be wide and still tells them apart.
const MARGIN: f64 = 10.0;

/// What is found in practice of one kind of value.
#[derive(Debug)]
pub(super) struct Usual {
    /// What a value makes, before the value: `cells of`.
    pub what: &'static str,
    /// The unit of a plain number, empty of a share.
    pub unit: &'static str,
    /// Smallest and largest that is found (in that unit); a smallest of 0 leaves small values alone.
    pub found: [f64; 2],
    /// The same in words.
    pub range: &'static str,
    /// Units that are meant where one was left out.
    pub others: &'static [&'static str],
}

/// The unit in which most drawings are.
const LENGTHS: &[&str] = &["mm"];

macro_rules! usual {
    ($($(#[$doc:meta])* $name:ident: $what:literal, $unit:literal, $found:expr, $range:literal, $others:expr;)+) => {
        $(
            $(#[$doc])*
            pub(super) const $name: Usual =
                Usual { what: $what, unit: $unit, found: $found, range: $range, others: $others };
        )+
        /// All of them, for the tests.
        #[cfg(test)]
        const ALL: &[(&str, Usual)] = &[$((stringify!($name), $name)),+];
    };
}

usual! {
    /// Grippers are no closer than their bodies are wide, and ply hangs down to the mold between distant ones.
    CELL: "cells of", "m", [0.02, 0.5], "cells are 20 mm to 500 mm wide", LENGTHS;
    /// As cells: the grippers are about as far apart as the fabric between them is long.
    SPACING: "grippers at a distance of", "m", [0.02, 0.5], "grippers are 20 mm to 500 mm apart", LENGTHS;
    /// From coupons of a test to plies that arrays of several robots carry.
    PLY: "a ply of", "m", [0.02, 5.0], "plies that grippers carry are 20 mm to 5 m long", LENGTHS;
    /// What is trimmed off, or hangs beyond the outermost grippers.
    OVERHANG: "fabric over a length of", "m", [0.0, 0.5], "such lengths are up to 500 mm", LENGTHS;
    /// From a pin to a window.
    HOLE: "a hole of", "m", [0.001, 1.0], "holes are 1 mm to 1 m wide", LENGTHS;
    /// From a veil to a thick non-crimp fabric.
    THICKNESS: "a thickness of", "m", [2e-5, 3e-3], "plies are 0.02 mm to 3 mm thick", &["mm", "um"];
    /// Robots reach 3 m, and a ply is picked up near its mold.
    HEIGHT: "grippers at a height of", "m", [0.0, 3.0], "grippers start up to 3 m high", LENGTHS;
    /// The longest halls and molds.
    COORDINATE: "a place at", "m", [0.0, 50.0], "halls and molds are up to 50 m long", LENGTHS;
    /// From a fillet to the barrel of a fuselage.
    RADIUS: "a radius of", "m", [0.005, 5.0], "molds have radii of 5 mm to 5 m", LENGTHS;
    /// From a needle gripper to a large suction plate.
    PAD: "a pad with a radius of", "m", [0.0, 0.1], "pads have radii of up to 100 mm", LENGTHS;
    /// From a cup to a robot's frame, a table or a gantry.
    BODY: "a body of", "m", [0.001, 10.0], "bodies and obstacles are 1 mm to 10 m large", LENGTHS;
    /// From the roughness of a mold to the thickness of a thick ply.
    TOLERANCE: "a contact tolerance of", "m", [1e-5, 1e-3], "tolerances of contact are 0.01 mm to 1 mm", LENGTHS;
    /// How closely a curve of a drawing is followed.
    DRAWN: "a tolerance of", "m", [1e-6, 5e-3], "tolerances of drawings are 0.001 mm to 5 mm", LENGTHS;
    /// A part of a cell.
    MESH: "meshes of", "m", [0.001, 0.1], "meshes are 1 mm to 100 mm wide", LENGTHS;
    /// From an engraved mark to a port for vacuum.
    SPANNED: "details of", "m", [0.0, 0.05], "details that a ply spans are up to 50 mm wide", LENGTHS;
    /// How far a gripper moves in one step of a plan.
    MOVE: "moves of", "m", [0.0005, 0.2], "grippers move 0.5 mm to 200 mm in a step", LENGTHS;
    /// Waves of a mold that is off its drawing.
    WAVES: "waves of", "m", [0.005, 2.0], "waves of molds are 5 mm to 2 m long", LENGTHS;
    /// From spread tow to 3D weaves and stitched stacks with their resin.
    AREAL_MASS: "a ply of", "kg/m^2", [0.05, 10.0], "plies weigh 50 g/m^2 to 10 kg/m^2", &["g/m^2"];
    /// An areal mass times the width of ply that a line stands for, at most a cell.
    LINE_MASS: "lines of ply of", "kg/m", [1e-3, 5.0], "lines of ply weigh 1 g/m to 5 kg/m", &["g/m"];
    /// Up to a thick prepreg; a limp ply has none.
    BENDING: "a bending rigidity of", "N m", [0.0, 0.1], "plies have up to 0.1 N m", &["mg cm", "uN m"];
    /// A bending rigidity times the width of ply that a line stands for.
    FLEXURAL: "a flexural rigidity of", "N m^2", [0.0, 0.05], "lines of ply have up to 0.05 N m^2", &["N mm^2"];
    /// From a knitted glass fabric to a heavy carbon one.
    TENSION: "a tensile stiffness of", "N/m", [1e4, 1e8], "plies have 1e4 N/m to 1e8 N/m", &["N/mm", "MN/m"];
    /// From a loose fabric to a stitched one with resin.
    SHEAR: "a shear slope of", "N/m per radian", [0.0, 1e4], "plies have up to 1e4 N/m per radian", &[];
    /// Bellows and springs to a rigid frame.
    MOUNT: "a mount of", "N/m", [20.0, 1e7], "mounts have 20 N/m to 1e7 N/m", &["N/mm"];
    /// From ice to rubber.
    FRICTION: "a coefficient of friction of", "", [0.0, 2.0], "coefficients of friction are up to 2", &["%"];
    /// On the Moon and on Earth.
    GRAVITY: "a gravity of", "m/s^2", [1.6, 9.9], "gravity is 1.6 m/s^2 on the Moon and 9.81 m/s^2 on Earth", &["mm/s^2"];
}

impl Usual {
    /// What is found in practice of a limit or what is like it.
    pub fn of<M: Measure>(practice: &Practice) -> Self {
        let others: &[&str] = match M::UNIT {
            "m" => LENGTHS,
            "m/s" => &["mm/s"],
            "m/s^2" => &["mm/s^2"],
            "m/s^3" => &["mm/s^3"],
            "rad/s" => &["deg/s"],
            _ => &[],
        };
        let Practice { what, found, words } = *practice;
        Usual { what, unit: M::UNIT, found, range: words, others }
    }

    /// Whether a plain number is believed. Zero and small negative numbers are not judged here: where they are wrong, it is not for
    /// their unit.
    pub fn holds(&self, value: f64) -> bool {
        let [low, high] = self.found;
        let too_small = 0.0 < value && value < low / MARGIN;
        !too_small && value.abs() <= high * MARGIN
    }

    /// The units in which a number would be found in practice; those in which it would be believed where there are none.
    pub fn meant(
        &self,
        number: f64,
        si: impl Fn(f64, Dimension) -> Option<f64>,
    ) -> Vec<&'static str> {
        let value = |unit: &str| {
            let (size, dimension) = units::unit(unit).ok()?;
            si(number.abs() * size, dimension)
        };
        let [low, high] = self.found;
        let among = |fits: &dyn Fn(f64) -> bool| -> Vec<&'static str> {
            let fits = |unit: &&&str| value(unit).is_some_and(fits);
            self.others.iter().filter(fits).copied().collect()
        };
        let found = among(&|value| (low..=high).contains(&value));
        if found.is_empty() { among(&|value| self.holds(value)) } else { found }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use plydrape::measure::Name;

    /// Units that are taken for each other differ by a thousand: a value in the middle of what is found, said in the wrong one of
    /// them, is never believed where the range is narrower than that.
    #[test]
    fn a_usual_value_in_the_wrong_unit_is_refused() {
        for (name, usual) in ALL.iter().filter(|(_, usual)| usual.others == LENGTHS) {
            let [low, high] = usual.found;
            assert!(low < high, "{name}");
            assert!(!usual.holds(1e3 * high), "{name}");
            let plain = if low > 0.0 { (low * high).sqrt() } else { 0.1 * high };
            assert!(usual.holds(plain), "{name}");
            let meant = usual.meant(1e3 * high, |value, _| Some(value));
            assert_eq!(meant.first(), Some(&"mm"), "{name}");
        }
    }

    /// The guide has a table of all of them.
    #[test]
    fn the_guide_says_what_is_found_in_practice() {
        let guide = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/guide/scene.md");
        let guide = std::fs::read_to_string(guide).unwrap();
        let limits = Name::bounded().filter_map(|(_, bound)| Some(bound.practice?.words));
        for words in ALL.iter().map(|(_, usual)| usual.range).chain(limits) {
            assert!(guide.contains(&format!("| {words} |\n")), "{words}");
        }
    }

    /// Every unit that is proposed can be read.
    #[test]
    fn the_units_of_the_table_are_known() {
        for (name, usual) in ALL {
            for unit in usual.others {
                assert!(units::unit(unit).is_ok(), "{name}: {unit}");
            }
        }
    }
}
