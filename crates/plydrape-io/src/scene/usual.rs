//! What plies, grippers and cells physically measure: the kinds of keys, which values each may have, and which plain numbers are believed.
//!
//! A key of a scene has one of these kinds as its type. Reader, refusals, JSON Schema and the page of every key take its unit, its range and
//! what is usual from there.
//!
//! A plain number is in SI units, and whoever leaves out a unit often thinks of another one: `cell = [100, 100]` would be cells of
//! 100 m. So every value is read with what is [`Usual`] of its key, and a plain number outside of that is refused, with the unit in which it
//! would make sense: in scenes, offsets, options of commands and arguments of Python. A value whose unit is written out is believed: `"100 m"`
//! is 100 m.

use super::motion::DURATIONS;
use super::quantity::{
    Acceleration, Allowed, Angle, AngularAcceleration, AngularRate, ArealMass, BendingRigidity,
    Coefficient, Curvature, FlexuralRigidity, Force, ForcePerLength, Frequency, Length,
    MassPerLength, Measure, MomentPerWidth, Pressure, Ratio, ShearSlope, Speed, Stiffness,
    Temperature, TensileStiffness, Time,
};
use super::units::{self, Dimension};
use plydrape::measure::Practice;

/// How far a plain number may be below and above what is found in practice. Units that are taken for each other differ by a thousand, and
/// those that are left out are mostly the smaller ones.
const MARGINS: [f64; 2] = [0.1, 2.0];
/// How far a plain angle or share may be off: a degree is a sixtieth of a radian, and a percent a hundredth of one.
const CLOSE_MARGINS: [f64; 2] = [1.0, 1.0];

/// What is found in practice of one kind of value.
#[derive(Debug, Clone, Copy)]
pub struct Usual {
    /// What a value makes, before the value: `cells of`.
    pub what: &'static str,
    /// The unit of a plain number, empty of a share.
    pub unit: &'static str,
    /// Smallest and largest that is found (in that unit); a smallest of 0 leaves small values alone.
    pub found: [f64; 2],
    /// That range as text.
    pub range: &'static str,
    /// Units that are meant where one was left out.
    pub others: &'static [&'static str],
    /// Smallest and largest size that is possible at all (in that unit).
    possible: [f64; 2],
}

/// The unit in which most drawings are.
const LENGTHS: &[&str] = &["mm"];

/// What has no unit, or may be of any size.
pub const ANY: Usual = Usual {
    what: "a value of",
    unit: "",
    found: [0.0, f64::INFINITY],
    range: "numbers of any size are usual",
    others: &[],
    possible: [0.0, f64::INFINITY],
};

/// Smallest and largest angular speed (rad/s) and acceleration (rad/s²) of a frame.
const TURNS: [f64; 2] = [1e-4, 1e4];

/// Kinds of keys: the measure, which values are allowed, and what is usual.
macro_rules! kinds {
    ($($(#[$doc:meta])* $name:ident: $measure:ident, $allowed:expr, $usual:expr;)+) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy)]
        pub struct $name;
        impl Measure for $name {
            const DIMENSIONS: &'static [Dimension] = $measure::DIMENSIONS;
            const NAME: &'static str = $measure::NAME;
            const UNIT: &'static str = $measure::UNIT;
            const EXAMPLE: &'static str = $measure::EXAMPLE;
            const ALLOWED: Allowed = $allowed;
            fn usual() -> Usual {
                $usual
            }
        }
    )+};
}

/// Kinds of keys with what a value makes, what is found in practice, that in words, and units that are meant where one was left out.
macro_rules! usual {
    ($($(#[$doc:meta])* $name:ident: $measure:ident, $allowed:expr, $what:literal, $found:expr, $range:literal, $others:expr;)+) => {
        kinds! { $($(#[$doc])* $name: $measure, $allowed, $name::USUAL;)+ }
        $(
            impl $name {
                /// What is found in practice.
                pub const USUAL: Usual =
                    Usual { what: $what, unit: $measure::UNIT, found: $found, range: $range, others: $others, ..ANY };
            }
        )+
        /// All of them, for the tests.
        #[cfg(test)]
        const ALL: &[(&str, Usual)] = &[$((stringify!($name), $name::USUAL)),+];
    };
}

usual! {
    /// Grippers are no closer than their bodies are wide, and ply hangs down to the mold between distant ones.
    Cell: Length, Allowed::Size, "cells of", [0.02, 0.5], "cells are 20 mm to 500 mm wide", LENGTHS;
    /// As cells: the grippers are about as far apart as the fabric between them is long.
    Spacing: Length, Allowed::Size, "grippers at a distance of", [0.02, 0.5], "grippers are 20 mm to 500 mm apart", LENGTHS;
    /// From coupons of a test to plies that arrays of several robots carry.
    PlySize: Length, Allowed::Size, "a ply of", [0.02, 5.0], "plies that grippers carry are 20 mm to 5 m long", LENGTHS;
    /// What is trimmed off, or hangs beyond the outermost grippers.
    Overhang: Length, Allowed::SizeOrZero, "fabric over a length of", [0.0, 0.5], "such lengths are up to 500 mm", LENGTHS;
    /// From a pin to a window.
    Hole: Length, Allowed::Size, "a hole of", [0.001, 1.0], "holes are 1 mm to 1 m wide", LENGTHS;
    /// From a veil to a thick non-crimp fabric.
    Thickness: Length, Allowed::Size, "a thickness of", [2e-5, 3e-3], "plies are 0.02 mm to 3 mm thick", &["mm", "um"];
    /// Robots reach 3 m, and a ply is picked up near its mold.
    Height: Length, Allowed::Coordinate, "grippers at a height of", [0.0, 3.0], "grippers start up to 3 m high", LENGTHS;
    /// The halls and molds of most cells.
    Coordinate: Length, Allowed::Coordinate, "a place at", [0.0, 30.0], "halls and molds are up to 30 m long", LENGTHS;
    /// A ply is laid near the origin of its mold.
    Place: Length, Allowed::Coordinate, "a place at", [0.0, 5.0], "plies, grippers and what is near to them are up to 5 m from the origin", LENGTHS;
    /// A point of a ply, in the flat.
    FabricPoint: Length, Allowed::Coordinate, "a point of the ply at", [0.0, 5.0], "points of a ply are up to 5 m from its origin", LENGTHS;
    /// From the flange of a robot to the frame that it carries.
    Flange: Length, Allowed::Coordinate, "a flange at", [0.0, 2.0], "flanges are up to 2 m from the frame", LENGTHS;
    /// An axis of a gripper.
    Stroke: Length, Allowed::Coordinate, "a stroke to", [0.0, 1.0], "strokes are up to 1 m long", LENGTHS;
    /// From a pin to a column.
    Cylinder: Length, Allowed::Size, "a cylinder with a radius of", [0.0005, 0.5], "cylinders have radii of 0.5 mm to 500 mm", LENGTHS;
    /// How far seen points may be from one another's offset.
    Landed: Length, Allowed::Positive, "a tolerance of", [0.0, 0.01], "tolerances of positions are up to 10 mm", LENGTHS;
    /// How far a ply lies from where it was planned.
    Shift: Length, Allowed::Finite, "a shift of", [0.0, 0.05], "plies are laid down within 50 mm", LENGTHS;
    /// How far a ply is turned from where it was planned.
    Yaw: Angle, Allowed::Finite, "a yaw of", [0.0, 0.175], "plies are laid down within 10 deg", &["deg"];
    /// Half a turn to either side.
    AnyAngle: Angle, Allowed::NotNegative, "an angle of", [0.0, 1.0001 * std::f64::consts::PI], "angles are up to half a turn, 3.1416 rad", &["deg"];
    /// What a table of a tension test reaches.
    Strain: Ratio, Allowed::NotNegative, "a strain of", [0.0, 0.1], "yarns stretch by up to 10 %", &["%"];
    /// What a picture-frame test measures.
    ShearForce: ForcePerLength, Allowed::NotNegative, "a shear force of", [0.0, 5e3], "plies are sheared with up to 5000 N/m", &["mN/mm"];
    /// What a tension test measures.
    TensionForce: ForcePerLength, Allowed::NotNegative, "a tension of", [0.0, 1e6], "plies bear up to 1e6 N/m", &["N/m"];
    /// From a flat ply to a fold.
    PlyCurvature: Curvature, Allowed::NotNegative, "a curvature of", [0.0, 1e3], "plies are bent with up to 1000 1/m", &["1/m"];
    /// What a bending test measures.
    Moment: MomentPerWidth, Allowed::NotNegative, "a moment of", [0.0, 10.0], "plies are bent with up to 10 N", &["mN"];
    /// From the stroke of a cup to a step aside.
    Clear: Length, Allowed::Size, "a way of", [0.001, 1.0], "pads come from 1 mm to 1 m above the ply", LENGTHS;
    /// How long pads press.
    Dwell: Time, Allowed::ZeroOrWithin([1e-6, 3600.0], "a dwell"), "a dwell of", [0.0, 60.0], "pads press for up to 60 s", &["ms"];
    /// Points of a motion that a machine follows.
    Rate: Frequency, Allowed::Within([0.1, 1e4], "a motion file"), "a rate of", [1.0, 1e3], "machines take 1 Hz to 1000 Hz", &["kHz"];
    /// From a slow frame to the wrist of a robot.
    TurnAcceleration: AngularAcceleration, Allowed::Within(TURNS, "a frame"), "an acceleration of", [1e-3, 20.0], "frames turn with 0.001 rad/s^2 to 20 rad/s^2", &["deg/s^2"];
    /// Joints of arms turn once round to either side at most.
    JointAngle: Angle, Allowed::Finite, "an angle of", [0.0, 7.0], "joints turn by up to 7 rad, 400 deg", &["deg"];
    /// Joints of arms, from the foot of a large one to the wrist of a small one.
    JointRate: AngularRate, Allowed::Within([1e-4, 1e3], "a joint"), "a rate of", [0.1, 15.0], "joints turn with 0.1 rad/s to 15 rad/s", &["deg/s"];
    /// As they come to their speed within some tenths of a second.
    JointAcceleration: AngularAcceleration, Allowed::Within([1e-3, 1e4], "a joint"), "an acceleration of", [0.1, 100.0], "joints turn with 0.1 rad/s^2 to 100 rad/s^2", &["deg/s^2"];
    /// Lines of ply, from a veil to a thick fabric of carbon.
    Axial: Force, Allowed::InfiniteOrWithin([1.0, 1e12], "a ply"), "an axial stiffness of", [1e4, 1e8], "lines of ply have 1e4 N to 1e8 N", &["kN", "MN"];
    /// From a dry fabric to a sticky prepreg.
    Tack: Pressure, Allowed::NotNegative, "a tack of", [0.0, 1e4], "plies stick with up to 1e4 Pa", &[];
    /// From a needle to a large suction plate.
    PadForce: Force, Allowed::Within([1e-6, 1e9], "a pad"), "a pad that holds", [0.01, 500.0], "pads hold 0.01 N to 500 N", &["mN"];
    /// How far a real cell is from its scene.
    CellError: Length, Allowed::NotNegative, "an error of", [0.0, 0.02], "errors of cells are up to 20 mm", LENGTHS;
    /// How far an angle of a real cell is from its scene.
    AngleError: Angle, Allowed::NotNegative, "an error of", [0.0, 0.1], "errors of angles are up to 0.1 rad, 5.7 deg", &["deg"];
    /// The length of one catenary, or of what hangs between two grippers.
    Span: Length, Allowed::Finite, "a span of", [0.002, 2.0], "spans are 2 mm to 2 m long", LENGTHS;
    /// The weight of a line of ply.
    Weight: ForcePerLength, Allowed::Finite, "a line of ply of", [1e-3, 50.0], "lines of ply weigh 0.001 N/m to 50 N/m", &["mN/m"];
    /// What a machine tests.
    Coupon: Length, Allowed::Finite, "a coupon of", [0.005, 1.0], "coupons are 5 mm to 1 m long", LENGTHS;
    /// How far a controller may be from a motion.
    PositionError: Length, Allowed::Finite, "an error of", [0.0, 0.01], "errors of positions are up to 10 mm", LENGTHS;
    /// From a fillet to the barrel of a fuselage.
    Radius: Length, Allowed::Size, "a radius of", [0.005, 5.0], "molds have radii of 5 mm to 5 m", LENGTHS;
    /// From a needle gripper to a large suction plate.
    Pad: Length, Allowed::SizeOrZero, "a pad with a radius of", [0.0, 0.1], "pads have radii of up to 100 mm", LENGTHS;
    /// From a thin one of silicone to a thick one of hard rubber.
    LipRigidity: BendingRigidity, Allowed::Within([1e-9, 1e6], "a lip"), "a lip with a rigidity of", [1e-5, 0.1], "lips have 1e-5 N m to 0.1 N m", &["mN m", "N mm"];
    /// From a cup to a robot's frame, a table or a gantry.
    Body: Length, Allowed::Size, "a body of", [0.001, 5.0], "bodies and obstacles are 1 mm to 5 m large", LENGTHS;
    /// From the roughness of a mold to the thickness of a thick ply.
    Tolerance: Length, Allowed::Size, "a contact tolerance of", [1e-5, 1e-3], "tolerances of contact are 0.01 mm to 1 mm", LENGTHS;
    /// How closely a curve of a drawing is followed.
    Drawn: Length, Allowed::Size, "a tolerance of", [1e-6, 5e-3], "tolerances of drawings are 0.001 mm to 5 mm", LENGTHS;
    /// A part of a cell.
    Mesh: Length, Allowed::Size, "meshes of", [0.001, 0.1], "meshes are 1 mm to 100 mm wide", LENGTHS;
    /// From an engraved mark to a port for vacuum.
    Spanned: Length, Allowed::SizeOrZero, "details of", [0.0, 0.05], "details that a ply spans are up to 50 mm wide", LENGTHS;
    /// How far a gripper moves in one step of a plan.
    Move: Length, Allowed::Size, "moves of", [0.0005, 0.2], "grippers move 0.5 mm to 200 mm in a step", LENGTHS;
    /// Waves of a mold that is off its drawing.
    Waves: Length, Allowed::Size, "waves of", [0.005, 2.0], "waves of molds are 5 mm to 2 m long", LENGTHS;
    /// From spread tow to 3D weaves and stitched stacks with their resin.
    PlyMass: ArealMass, Allowed::Finite, "a ply of", [0.05, 10.0], "plies weigh 50 g/m^2 to 10 kg/m^2", &["g/m^2"];
    /// An areal mass times the width of ply that a line stands for, at most a cell.
    LineMass: MassPerLength, Allowed::Finite, "lines of ply of", [1e-3, 5.0], "lines of ply weigh 1 g/m to 5 kg/m", &["g/m"];
    /// Up to a thick prepreg; a limp ply has none.
    Bending: BendingRigidity, Allowed::ZeroOrWithin([0.0, 1e6], "a ply"), "a bending rigidity of", [0.0, 0.1], "plies have up to 0.1 N m", &["mg cm", "uN m"];
    /// A bending rigidity times the width of ply that a line stands for.
    Flexural: FlexuralRigidity, Allowed::ZeroOrWithin([0.0, 1e6], "a ply"), "a flexural rigidity of", [0.0, 0.05], "lines of ply have up to 0.05 N m^2", &["N mm^2"];
    /// From a knitted glass fabric to a heavy carbon one.
    Tension: TensileStiffness, Allowed::Within([1.0, 1e10], "a ply"), "a tensile stiffness of", [1e4, 1e8], "plies have 1e4 N/m to 1e8 N/m", &["N/mm", "MN/m"];
    /// From a loose fabric to a stitched one with resin.
    Shear: ShearSlope, Allowed::ZeroOrWithin([0.0, 1e6], "a ply"), "a shear slope of", [0.0, 1e4], "plies have up to 1e4 N/m per radian", &[];
    /// From the freezer to the debulking of a hot ply.
    PlyTemperature: Temperature, Allowed::Within([50.0, 2000.0], "a ply"), "a temperature of", [250.0, 450.0], "plies are laid at 250 K to 450 K, -23 degC to 177 degC", &["degC"];
    /// From a hot resin to a cold one.
    Relaxation: Time, Allowed::Within([1e-9, 1e9], "a ply"), "a relaxation of", [1e-3, 1e4], "resins relax within 1 ms to 3 h", &["ms"];
    /// Bellows and springs to a rigid frame.
    Mount: Stiffness, Allowed::Within([1e-3, 1e9], "a gripper's mount"), "a mount of", [500.0, 1e7], "mounts have 500 N/m to 1e7 N/m", &["N/mm"];
    /// From ice to rubber.
    Friction: Coefficient, Allowed::NotNegative, "a coefficient of friction of", [0.0, 2.0], "coefficients of friction are up to 2", &["%"];
    /// On the Moon and on Earth.
    Gravity: Acceleration, Allowed::Within([1e-3, 1e3], "a ply"), "a gravity of", [1.6, 9.9], "gravity is 1.6 m/s^2 on the Moon and 9.81 m/s^2 on Earth", &["mm/s^2"];
}

kinds! {
    /// A direction from x towards y, or a turn about an axis.
    Heading: Angle, Allowed::Turn, AnyAngle::USUAL;
    /// How steep something is.
    Slope: Angle, Allowed::BelowRightAngle, AnyAngle::USUAL;
    /// How far a joint tilts, or yarns turn against each other.
    AcuteAngle: Angle, Allowed::Acute, AnyAngle::USUAL;
    /// By how much a ply is sheared, to either side.
    ShearAngle: Angle, Allowed::ShearAngle, AnyAngle::USUAL;
    /// What a resin adds to the slope of shear.
    ShearRate: ShearSlope, Allowed::Within([0.0, 1e6], "a ply"), Shear::USUAL;
    /// How long pads press before a ply is lifted.
    Grip: Time, Allowed::NotNegative, Dwell::USUAL;
    /// How long a program waits.
    Timeout: Time, Allowed::Positive, Dwell::USUAL;
    /// From the first to the last step of a motion.
    Duration: Time, Allowed::Within(DURATIONS, "a motion"), Usual::from_practice::<Time>(&Practice::DURATION);
    /// How fast a frame turns.
    TurnRate: AngularRate, Allowed::Within(TURNS, "a frame"), Usual::from_practice::<AngularRate>(&Practice::TURN);
    /// How fast an axis moves.
    AxisSpeed: Speed, Allowed::Within([1e-5, 1e2], "an axis"), Usual::from_practice::<Speed>(&Practice::SPEED);
    /// How far a gripper may be from where it should be.
    Residual: Length, Allowed::Size, Usual::from_practice::<Length>(&Practice::GAP);
    /// A part of a value.
    Share: Ratio, Allowed::NotNegative, ANY;
    /// A factor that a value is known within.
    Factor: Ratio, Allowed::Positive, ANY;
    /// The part of many cells that keeps the limits.
    CellShare: Ratio, Allowed::PartOf("all of the cells"), ANY;
    /// By how much a pad must hold more than its load.
    GripSafety: Ratio, Allowed::Within([1.0, 100.0], "the safety of a pad"), ANY;
}

impl Usual {
    /// What is found in practice of a limit or what is like it.
    pub(super) fn from_practice<M: Measure>(practice: &Practice) -> Self {
        let others: &[&str] = match M::UNIT {
            "m" => LENGTHS,
            "m/s" => &["mm/s"],
            "m/s^2" => &["mm/s^2"],
            "m/s^3" => &["mm/s^3"],
            "rad/s" => &["deg/s"],
            "s" => &["ms"],
            "N" => &["mN"],
            "rad" => &["deg"],
            "" => &["%"],
            _ => &[],
        };
        let Practice { what, found, words } = *practice;
        Usual { what, unit: M::UNIT, found, range: words, others, possible: [0.0, f64::INFINITY] }
    }

    /// The usual values, with the range (in that unit) outside of which none is possible.
    pub(super) fn within(self, possible: [f64; 2]) -> Self {
        Usual { possible, ..self }
    }

    /// Whether a number (in that unit) is possible, be it usual or not.
    pub(super) fn allows(&self, number: f64) -> bool {
        let [low, high] = self.possible;
        (low..=high).contains(&number.abs())
    }

    /// Whether a plain number is believed. Zero and small negative numbers are not judged here: where they are wrong, it is not for
    /// their unit.
    pub(super) fn holds(&self, value: f64) -> bool {
        let [low, high] = self.found;
        let [below, above] = match self.unit {
            "" | "rad" | "rad/s" | "rad/s^2" | "K" => CLOSE_MARGINS,
            _ => MARGINS,
        };
        let too_small = 0.0 < value && value < low * below;
        !too_small && value.abs() <= high * above
    }

    /// The units in which a number would be found in practice; those in which it would be believed where there are none.
    pub(super) fn meant(
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

    /// A scene with more lines in its tables.
    fn checked(lines: &[(&str, &str)]) -> Result<(), crate::Error> {
        let own = [
            ("ply", "grippers = [2, 2]\ncell = [0.1, 0.1]\nmaterial = \"prepreg_warm\""),
            ("mold", "kind = \"plane\""),
            ("target", ""),
        ];
        let set =
            |name: &str, key: &str| lines.iter().any(|(n, l)| *n == name && l.starts_with(key));
        let mut text = String::new();
        let mut tables: Vec<&str> = own.iter().map(|(name, _)| *name).collect();
        tables.extend(
            lines.iter().map(|(name, _)| *name).filter(|name| own.iter().all(|(n, _)| n != name)),
        );
        for table in tables {
            text += &format!("[{table}]\n");
            let usual = own.iter().filter(|(name, _)| *name == table).flat_map(|(_, l)| l.lines());
            for line in usual.filter(|line| !set(table, line.split(' ').next().unwrap_or(line))) {
                text += &format!("{line}\n");
            }
            for (_, line) in lines.iter().filter(|(name, _)| *name == table) {
                text += &format!("{line}\n");
            }
        }
        crate::scene::parse(&text, std::path::Path::new(""), "scene.toml").map(|_| ())
    }

    /// What somebody writes who thinks of millimeters, degrees, percent, newtons per millimeter, milliseconds or grams: each is refused with that
    /// unit, and what is proposed is not refused for its unit.
    #[test]
    fn a_number_in_another_unit_is_asked_about() {
        // table, line with a number as somebody may write it, and what was meant
        let cases: [(&str, &str, &str); 44] = [
            ("ply", "cell = [100, 100]", "100 mm"),
            ("ply", "overhang = 20", "20 mm"),
            ("ply", "thickness = 0.3", "0.3 mm"),
            ("mold", "point = [500, 0, 0]", "500 mm"),
            ("tool", "world = { rotation = [0, 0, 45] }", "45 deg"),
            ("target", "origin = [100, 50]", "100 mm"),
            ("target", "direction = 30", "30 deg"),
            ("target", "shear = 10", "10 deg"),
            ("target", "mesh = 5", "5 mm"),
            ("grippers", "height = 75", "75 mm"),
            ("grippers", "pad_radius = 15", "15 mm"),
            ("grippers", "max_tilt = 40", "40 deg"),
            ("grippers", "stiffness = { lateral = 20 }", "20 N/mm"),
            ("grippers", "stiffness = { axial = 5 }", "5 N/mm"),
            ("grippers", "slip_force = 5000", "5000 mN"),
            ("[bodies]", "cylinder = { radius = 15, to = 0.04 }", "15 mm"),
            ("[bodies]", "cylinder = { radius = 0.015, to = 40 }", "40 mm"),
            ("[bodies]", "box = { size = [30, 0.03, 0.05] }", "30 mm"),
            ("tool", "turn_rate = 30", "30 deg/s"),
            ("tool", "turn_acceleration = 180", "180 deg/s^2"),
            ("tool", "flange = { position = [0, 0, 300] }", "300 mm"),
            ("tool", "axes = [{ direction = \"z\", stroke = [-20, 120] }]", "-20 mm"),
            (
                "tool",
                "axes = [{ direction = \"z\", stroke = [-0.02, 0.12], speed = 200 }]",
                "200 mm/s",
            ),
            ("limits", "strain = 0.5", "0.5 %"),
            ("limits", "slack_ratio = 0.05", "0.05 %"),
            ("limits", "overstretch = 0.2", "0.2 %"),
            ("limits", "height = 0.5", "0.5 mm"),
            ("limits", "position = 2", "2 mm"),
            ("limits", "clearance = 5", "5 mm"),
            ("limits", "gripper_distance = 50", "50 mm"),
            ("limits", "fiber_angle = 3", "3 deg"),
            ("limits", "out_of_plane = 1", "1 deg"),
            ("limits", "tilt_rate = 90", "90 deg/s"),
            ("limits", "speed = 250", "250 mm/s"),
            ("limits", "acceleration = 1000", "1000 mm/s^2"),
            ("limits", "jerk = 10000", "10000 mm/s^3"),
            ("limits", "duration = 20000", "20000 ms"),
            ("limits", "gripper_load = 10000", "10000 mN"),
            ("motion", "duration = 20000", "20000 ms"),
            ("sheet", "mesh = 5", "5 mm"),
            ("contact", "tolerance = 0.2", "0.2 mm"),
            ("release", "dwell = 500", "500 ms"),
            ("pick_up", "clearance = 50", "50 mm"),
            ("pick_up", "grip = 500", "500 ms"),
        ];

        let mut missed = Vec::new();
        for (table, line, meant) in cases {
            // keys without which the table is refused for another reason
            let kind = match table {
                "motion" => "kind = \"straight\"\n",
                "pick_up" => "height = \"0 mm\"\n",
                "[bodies]" => "name = \"cup\"\non = \"pad\"\n",
                _ => "",
            };
            let asked = |line: &str| match checked(&[(table, &format!("{kind}{line}"))]) {
                Ok(()) => String::new(),
                Err(refused) => format!("{} {}", refused.message(), refused.help()),
            };

            // the line with the number alone must be asked about, and that with the unit must not
            let number = meant.split(' ').next().unwrap_or(meant);
            let quoted = line
                .replace(&format!(" {number}"), &format!(" \"{meant}\""))
                .replace(&format!("[{number}"), &format!("[\"{meant}\""));
            let (plain, with_unit) = (asked(line), asked(&quoted));
            if !plain.contains(&format!("\"{meant}\"")) {
                missed.push(format!("{line}: {plain}"));
            }
            if with_unit.contains(&format!("`{number}`")) {
                missed.push(format!("{quoted}: {with_unit}"));
            }
        }

        assert!(missed.is_empty(), "{}", missed.join("\n"));
    }

    /// In the column of every key, or in the table of what is no key.
    #[test]
    fn the_guide_says_what_is_found_in_practice() {
        let page = |name: &str| {
            let guide = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/guide");
            std::fs::read_to_string(format!("{guide}/{name}")).unwrap()
        };
        let guide = page("scene.md") + &page("keys.md");
        let limits = Name::bounded().filter_map(|(_, bound)| Some(bound.practice?.words));
        for words in ALL.iter().map(|(_, usual)| usual.range).chain(limits) {
            assert!(guide.contains(&format!("| {words} |")), "{words}");
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
