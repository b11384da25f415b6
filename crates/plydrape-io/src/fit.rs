//! Laws of a material from the tables of its tests, and the lines of a material file that say them.

use crate::Error;
use crate::scene::{FitTable, Reading, read_fit};
use crate::store::shown;
use plydrape::Error as Cause;
use plydrape::fit::{
    BiasExtension, Estimate, Hang, MomentFit, Overhang, PictureFrame, PointFault, RateFit, Remark,
    ShearFit, ShearSpecimen, ShearTest, Sure, TimedSpecimen, fit_hang, fit_moments, fit_rate,
    fit_shear,
};
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Acceleration of gravity (m/s²), as in scenes.
const GRAVITY: f64 = 9.81;

/// A test of a material. Each measure is that which a file states of its own specimen, else the one that is given here for all of them.
#[derive(Debug, Clone, PartialEq)]
pub enum Test {
    /// Bias extension: width and length of the specimens (m).
    Bias {
        /// Width (m).
        width: Option<f64>,
        /// Length between the clamps (m).
        length: Option<f64>,
    },
    /// Bias extension in time, at several speeds or held: width and length of the specimens (m).
    Rate {
        /// Width (m).
        width: Option<f64>,
        /// Length between the clamps (m).
        length: Option<f64>,
    },
    /// Picture frame: side of the frame and of the fabric in it (m).
    Frame {
        /// Side (m).
        side: Option<f64>,
        /// Side of the fabric (m); that of the frame unless given.
        fabric: Option<f64>,
    },
    /// Overhangs at an angle of the chord.
    Overhang {
        /// Mass per area (kg/m²).
        mass: Option<f64>,
        /// Angle of the chord (rad).
        angle: f64,
    },
    /// Points of hanging strips.
    Hang {
        /// Mass per area (kg/m²).
        mass: Option<f64>,
        /// Length of the overhang (m).
        length: Option<f64>,
    },
    /// Moment over curvature.
    Moments,
}

/// What is to be fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The test.
    pub test: Test,
    /// Tables of specimens: of a shear test, or of strips along the warp.
    pub warp: Vec<PathBuf>,
    /// Tables of strips along the weft.
    pub weft: Vec<PathBuf>,
    /// Titles of the columns of the test where they have other names than usual: displacement and force, overhang, x and z, or curvature
    /// and moment.
    pub titles: [Option<String>; 2],
}

/// Bending along one direction.
#[derive(Debug, Clone, PartialEq)]
pub enum BendingFit {
    /// A rigidity per width (N·m), and each strip's with its angle at the edge (rad) where points were fitted.
    Rigidity(Estimate, Vec<(String, [Estimate; 2])>),
    /// A curve of the moment.
    Curve(MomentFit),
}

/// A fitted law.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The test in words.
    pub test: String,
    /// The files that it comes from.
    pub files: Vec<String>,
    /// Mass per area that was used (kg/m²); the mean where files state different ones.
    pub mass: Option<f64>,
    /// What is to be known of the files beside the law, as whole lines.
    pub notes: Vec<String>,
    /// Bending along warp and weft.
    pub bending: [Option<BendingFit>; 2],
    /// Shear.
    pub shear: Option<ShearFit>,
    /// What resin adds to shear.
    pub rate: Option<RateFit>,
}

/// A specimen: its name and its table.
type Specimen = (String, FitTable);

/// Fits a law.
///
/// # Errors
/// If a table is broken, a measure is missing, or the points say no law.
pub fn fit(request: &Request) -> Result<Fitted, Error> {
    // nothing is fitted yet; the result lists the files of both directions
    let all = request.warp.iter().chain(&request.weft);
    let mut fitted = Fitted {
        test: String::new(),
        files: all.map(|path| name(path)).collect(),
        mass: None,
        notes: Vec::new(),
        bending: [None, None],
        shear: None,
        rate: None,
    };

    // tables of warp and weft, read with the columns that a test needs
    let titles = [0, 1].map(|n| request.titles[n].as_deref());
    let tables_of = |reading: Reading| -> Result<[Vec<Specimen>; 2], Error> {
        let read = |paths: &[PathBuf]| -> Result<Vec<_>, Error> {
            paths.iter().map(|path| Ok((name(path), read_fit(path, reading, &titles)?))).collect()
        };
        Ok([read(&request.warp)?, read(&request.weft)?])
    };

    // each test fits its own law, and says in words what was tested
    match &request.test {
        Test::Bias { width, length } => {
            let [tables, _] = tables_of(Reading::Pull)?;
            let test = |table: &FitTable| {
                let width = table.measure("width", *width)?;
                let length = table.measure("length", *length)?;
                Ok(ShearTest::Bias(BiasExtension { width, length }))
            };
            let sizes = fitted.sheared(&tables, test)?;
            let specimens = specimens(tables.len());
            fitted.test = format!("bias extension, {specimens} of {sizes}");
        }
        Test::Rate { width, length } => {
            let [tables, _] = tables_of(Reading::Timed)?;
            fitted.timed(&tables, *width, *length)?;
            fitted.test = format!("bias extension in time, {}", specimens(tables.len()));
        }
        Test::Frame { side, fabric } => {
            let [tables, _] = tables_of(Reading::Pull)?;
            let test = |table: &FitTable| {
                let side = table.measure("side", *side)?;
                let fabric = table.stated("fabric", *fabric)?.unwrap_or(side);
                Ok(ShearTest::Frame(PictureFrame { side, fabric }))
            };
            let sizes = fitted.sheared(&tables, test)?;
            fitted.test = format!("picture frame of {sizes}, {}", specimens(tables.len()));
        }
        Test::Overhang { mass, angle } => {
            let tables = tables_of(Reading::Overhang)?;
            fitted.weigh(&tables, *mass)?;
            let rigidity = |tables: &[Specimen]| overhanging(tables, *mass, *angle);
            fitted.bending = [rigidity(&tables[0])?, rigidity(&tables[1])?];
            fitted.test = format!("cantilever, chord at {} deg", short(angle.to_degrees()));
        }
        Test::Hang { mass, length } => {
            let tables = tables_of(Reading::Points)?;
            fitted.weigh(&tables, *mass)?;
            let rigidity = |tables: &[Specimen]| hanging(tables, *mass, *length);
            fitted.bending = [rigidity(&tables[0])?, rigidity(&tables[1])?];
            fitted.test = "points of hanging strips, fitted by the exact elastica".into();
        }
        Test::Moments => {
            let [warp, weft] = tables_of(Reading::Moment)?;
            fitted.bending = [fitted.moments(&warp)?, fitted.moments(&weft)?];
            fitted.test = "moment over curvature, mean of both sides and both ways".into();
        }
    }
    Ok(fitted)
}

/// The rigidity of strips that hang over an edge, of a mass (kg/m²) unless their files say it, to an angle of the chord (rad).
fn overhanging(
    tables: &[Specimen],
    mass: Option<f64>,
    angle: f64,
) -> Result<Option<BendingFit>, Error> {
    let mut rigidities = Vec::new();
    for (_, table) in tables {
        let weight = GRAVITY * table.measure("mass", mass)?;
        let overhangs: Vec<f64> = table.rows.iter().map(|row| row[0]).collect();
        rigidities.extend(Overhang { weight, angle }.rigidities(&overhangs)?);
    }
    let estimate = || BendingFit::Rigidity(Estimate::of_specimens(&rigidities), Vec::new());
    Ok((!rigidities.is_empty()).then(estimate))
}

/// The rigidity of strips by points along them, of a mass (kg/m²) and a length (m) unless their files say them.
fn hanging(
    tables: &[Specimen],
    mass: Option<f64>,
    length: Option<f64>,
) -> Result<Option<BendingFit>, Error> {
    let mut strips = Vec::with_capacity(tables.len());
    for (name, table) in tables {
        let length = table.measure("length", length)?;
        let weight = GRAVITY * table.measure("mass", mass)?;
        strips.push((name.clone(), Hang { points: table.rows.clone(), length, weight }));
    }
    if strips.is_empty() {
        return Ok(None);
    }
    let (whole, each) = fit_hang(&strips).map_err(|cause| placed(tables, cause))?;
    let names = strips.into_iter().map(|(name, _)| name);
    Ok(Some(BendingFit::Rigidity(whole, names.zip(each).collect())))
}

/// A fault of the points of a specimen at its row, and one of its record at its header.
fn placed(tables: &[Specimen], cause: Cause) -> Error {
    // only faults of points and of records have a file and a place in it
    let (Cause::FitPoint { what, .. } | Cause::FitReach { what, .. }) = &cause else {
        return cause.into();
    };
    let Some((_, table)) = tables.iter().find(|(name, _)| name == what) else {
        return cause.into();
    };

    // the fault is in the first column of its row or in the last one
    let point = match &cause {
        Cause::FitPoint { point, fault, .. } => {
            let column = match fault {
                PointFault::Backwards
                | PointFault::Returns
                | PointFault::Falls
                | PointFault::BehindEdge => 0,
                PointFault::BelowZero
                | PointFault::NotZero
                | PointFault::FallsEarly
                | PointFault::Upwards
                | PointFault::Untimely => 1,
            };
            Some(([*point, column], fault.to_string()))
        }
        _ => None,
    };

    // a fault of a point is shown at its row, one of the record at the header
    let error = Error::from(cause);
    match point {
        Some((place, fault)) => table.error(place, fault, error.help()),
        None => table.error_anywhere(error.message(), error.help()),
    }
}

/// What a record holds, in the words of notes.
struct Words {
    /// What is applied, its unit, and that unit in SI units.
    applied: (&'static str, &'static str, f64),
    /// What answers, and its SI unit.
    load: (&'static str, &'static str),
    /// The unit of what the law goes over, and that unit in SI units.
    reach: (&'static str, f64),
}

const SHEAR: Words = Words {
    applied: ("displacements", "mm", 1e-3),
    load: ("force", "N"),
    reach: ("deg", std::f64::consts::PI / 180.0),
};
const MOMENT: Words =
    Words { applied: ("curvatures", "1/m", 1.0), load: ("moment", "N"), reach: ("1/m", 1.0) };

/// How different reaches and masses are named, as a share.
const DIFFERENT: f64 = 0.05;

impl Fitted {
    /// Fits the shear of specimens, each by its own test; their sizes in words.
    fn sheared(
        &mut self,
        tables: &[Specimen],
        test: impl Fn(&FitTable) -> Result<ShearTest, Error>,
    ) -> Result<String, Error> {
        let (mut specimens, mut sizes) = (Vec::with_capacity(tables.len()), Vec::new());
        for (name, table) in tables {
            let test = test(table)?;
            test.check().map_err(|cause| {
                let error = Error::from(cause);
                table.error_anywhere(error.message(), error.help())
            })?;
            let size = size(&test);
            if !sizes.contains(&size) {
                sizes.push(size);
            }
            specimens.push(ShearSpecimen { name: name.clone(), test, points: table.rows.clone() });
        }
        let found = fit_shear(&specimens).map_err(|cause| placed(tables, cause))?;
        self.remark(tables, &found.remarks, &SHEAR);
        self.reached(tables, &found.reach, &SHEAR);
        self.shear = Some(found);
        Ok(sizes.join(" and "))
    }

    /// Fits what resin adds to the shear of specimens, of a width and a length (m) unless their files say them.
    fn timed(
        &mut self,
        tables: &[Specimen],
        width: Option<f64>,
        length: Option<f64>,
    ) -> Result<(), Error> {
        let mut timed = Vec::with_capacity(tables.len());
        for (name, table) in tables {
            let width = table.measure("width", width)?;
            let length = table.measure("length", length)?;
            timed.push(TimedSpecimen {
                name: name.clone(),
                test: BiasExtension { width, length },
                points: table.rows.clone(),
                times: table.times.clone(),
            });
        }
        self.rate = Some(fit_rate(&timed).map_err(|cause| placed(tables, cause))?);
        Ok(())
    }

    /// The curve of the moment of specimens, with notes on their records.
    fn moments(&mut self, tables: &[Specimen]) -> Result<Option<BendingFit>, Error> {
        if tables.is_empty() {
            return Ok(None);
        }
        let specimens: Vec<_> =
            tables.iter().map(|(name, table)| (name.clone(), table.rows.clone())).collect();
        let found = fit_moments(&specimens).map_err(|cause| placed(tables, cause))?;
        self.remark(tables, &found.remarks, &MOMENT);
        self.reached(tables, &found.reach, &MOMENT);
        Ok(Some(BendingFit::Curve(found)))
    }

    /// The mass per area of all specimens.
    fn weigh(&mut self, tables: &[Vec<Specimen>; 2], given: Option<f64>) -> Result<(), Error> {
        let mut masses = Vec::new();
        for (name, table) in tables.iter().flatten() {
            masses.push((name, table.measure("mass", given)?));
        }
        let mean = masses.iter().map(|(_, mass)| mass).sum::<f64>() / masses.len().max(1) as f64;
        if masses.iter().any(|(_, mass)| short(*mass) != short(mean)) {
            let each: Vec<String> = masses
                .iter()
                .map(|(name, mass)| format!("{name} {} kg/m^2", short(*mass)))
                .collect();
            self.notes.push(format!(
                "the files state different masses, and each is used for its own strips; the mass below is their mean: {}",
                each.join(", ")
            ));
        }
        self.mass = Some(mean);
        Ok(())
    }

    /// Notes what is to be known of records.
    fn remark(&mut self, tables: &[Specimen], remarks: &[Vec<Remark>], words: &Words) {
        let (applied, unit, size) = words.applied;
        let (load, load_unit) = words.load;
        for ((name, table), remarks) in tables.iter().zip(remarks) {
            // where in the file the points are
            let lines = |points: [usize; 2]| match points.map(|point| table.line(point)) {
                [first, last] if first == last => format!("line {first} is left out"),
                [first, last] => format!("lines {first} to {last} are left out"),
            };
            for remark in remarks {
                let note = match *remark {
                    // points that the fit leaves out
                    Remark::AfterPeak { points, peak } => format!(
                        "{}, because the {load} has fallen from its peak of {} {load_unit}",
                        lines(points),
                        short(peak)
                    ),
                    Remark::Unloading { points } => {
                        format!("{}, because the machine runs back there", lines(points))
                    }
                    Remark::BeyondTrellis { points } => format!(
                        "{}, because no weave is a trellis beyond 65 deg of shear",
                        lines(points)
                    ),
                    Remark::BeyondShear { points, angle } => format!(
                        "{}, because the shear force falls beyond {} deg: the specimen slips",
                        lines(points),
                        short(angle.to_degrees())
                    ),
                    Remark::BeyondPeak { curvature } => format!(
                        "points beyond {} 1/m are left out, because the {load} has fallen from its peak",
                        short(curvature)
                    ),
                    // points that it uses, but that somebody should check
                    Remark::BeginsLate { first } => format!(
                        "its {applied} begin at {} {unit}, which is taken for the way from no load: see whether that is so",
                        short(first / size)
                    ),
                    Remark::LoadAtRest { load: value } => format!(
                        "its first points lead to a {load} of {} {load_unit} before anything is deformed: see whether the load cell was set to zero",
                        short(value)
                    ),
                };
                self.notes.push(format!("{name}: {note}"));
            }
        }
    }

    /// Notes specimens that went farther than the law does.
    fn reached(&mut self, tables: &[Specimen], reach: &[f64], words: &Words) {
        let (unit, size) = words.reach;
        let shared = reach.iter().copied().fold(f64::INFINITY, f64::min);
        for ((name, _), own) in tables.iter().zip(reach) {
            if *own > (1.0 + DIFFERENT) * shared {
                self.notes.push(format!(
                    "{name}: it goes on to {} {unit}, and the law ends at {} {unit}, which all specimens reach",
                    short(own / size),
                    short(shared / size)
                ));
            }
        }
    }
}

/// The size of a specimen in words.
fn size(test: &ShearTest) -> String {
    match test {
        ShearTest::Bias(BiasExtension { width, length }) => {
            format!("{} x {} mm", short(1e3 * width), short(1e3 * length))
        }
        ShearTest::Frame(PictureFrame { side, .. }) => format!("{} mm", short(1e3 * side)),
    }
}

fn specimens(count: usize) -> String {
    if count == 1 { "one specimen".into() } else { format!("{count} specimens") }
}

fn name(path: &Path) -> String {
    shown::path(path)
}

/// Four digits.
fn short(value: f64) -> String {
    shown::short(value, 4, 1e6)
}

/// How sure an estimate is, in words; `specimens` are those whose residuals say it.
fn sure(estimate: &Estimate, unit: &str, specimens: &str) -> String {
    let Some([low, high]) = estimate.interval() else {
        return "one specimen: how sure it is, is not known".into();
    };
    let from = match estimate.sure {
        Sure::Specimens(count) => format!("from {count} specimens"),
        _ => format!("from the residuals of {specimens}"),
    };
    format!("95 % interval {} to {} {unit}, {from}", short(low), short(high))
}

const DIRECTIONS: [&str; 2] = ["warp", "weft"];

impl Fitted {
    /// Scatter of each key, as a share.
    fn scatter(&self) -> Vec<(String, f64)> {
        let mut found = Vec::new();
        for (bending, along) in self.bending.iter().zip(DIRECTIONS) {
            let share = match bending {
                Some(BendingFit::Rigidity(estimate, _)) => estimate.scatter,
                Some(BendingFit::Curve(fit)) => fit.scatter,
                None => None,
            };
            found.extend(share.map(|share| (format!("bending_rigidity_{along}"), share)));
        }
        let shear = self.shear.as_ref().and_then(|shear| shear.scatter);
        found.extend(shear.map(|share| ("shear_curve".to_string(), share)));
        found
    }

    /// The lines of a material file that say what was fitted.
    #[must_use]
    pub fn toml(&self) -> String {
        // lists of numbers with their unit, and texts without the quotes that would end them
        let list = |values: &[f64], unit: &str| {
            let items: Vec<String> = values
                .iter()
                .map(|v| if *v == 0.0 { "0".into() } else { format!("\"{}{unit}\"", short(*v)) })
                .collect();
            items.join(", ")
        };
        let quoted = |text: &str| text.replace('\\', "/").replace('"', "'");

        // where the values are from, and what is to be known of them
        let mut text = format!(
            "# Fitted by {}. A material file needs `mass`, bending along warp and weft, and for the sheet `tension` and `shear_curve`.\n",
            crate::PROGRAM
        );
        let _ = writeln!(text, "source = \"fitted from {}\"", quoted(&self.files.join(", ")));
        let _ = writeln!(text, "test = \"{}\"", quoted(&self.test));
        for note in &self.notes {
            let _ = writeln!(text, "# {}", note.escape_debug());
        }

        // mass and bending, with the standard error in a comment above each value
        if let Some(mass) = self.mass {
            let _ = writeln!(text, "mass = \"{} kg/m^2\"", short(mass));
        }
        for (bending, along) in self.bending.iter().zip(DIRECTIONS) {
            match bending {
                Some(BendingFit::Rigidity(estimate, each)) => {
                    let _ = writeln!(
                        text,
                        "# {}\nbending_rigidity_{along} = \"{} N m\"",
                        sure(estimate, "N m", "one specimen"),
                        short(estimate.value)
                    );
                    for (file, [_, angle]) in each {
                        let degrees = short(angle.value.to_degrees());
                        let _ = writeln!(
                            text,
                            "# {}: fitted angle at the edge {degrees} deg; if the clamp was not so, no single rigidity hangs this strip",
                            file.escape_debug()
                        );
                    }
                }
                Some(BendingFit::Curve(MomentFit { curve, .. })) => {
                    let _ = writeln!(
                        text,
                        "# rigidity at rest {} N m\nbending_rigidity_{along} = {{ curvature = [{}], moment = [{}] }}",
                        short(curve.rigidity()),
                        list(&curve.curvature, " 1/m"),
                        list(&curve.moment, " N")
                    );
                }
                None => {}
            }
        }

        // the shear curve as a table; its polynomial and a hint of locking are comments
        if let Some(shear) = &self.shear {
            let degrees: Vec<f64> = shear.angle.iter().map(|angle| angle.to_degrees()).collect();
            if let Some(polynomial) = shear.polynomial {
                let term = |[c, error]: [f64; 2]| format!("{} ± {}", short(c), short(error));
                let _ = writeln!(
                    text,
                    "# as a polynomial of the angle in rad: {} N/m (standard errors from the residuals)",
                    polynomial.map(term).join(", ")
                );
            }
            if let Some(angle) = shear.locking {
                let _ = writeln!(
                    text,
                    "# the curve turns up at {} deg: look there for locking, locking_angle and locking_test",
                    short(angle.to_degrees())
                );
            }
            let _ = writeln!(
                text,
                "shear_curve = {{ angle = [{}], force = [{}] }}",
                list(&degrees, " deg"),
                list(&shear.force, " N/m")
            );
        }

        // the rate effect of resin, and the shear curve without it
        if let Some(rate) = &self.rate {
            let degrees: Vec<f64> = rate.angle.iter().map(|angle| angle.to_degrees()).collect();
            let _ = writeln!(
                text,
                "# of very slow shear; what is left of the forces of the machine is {} N\nshear_curve = {{ angle = [{}], force = [{}] }}",
                short(rate.residual),
                list(&degrees, " deg"),
                list(&rate.force, " N/m")
            );
            let _ = writeln!(
                text,
                "# stiffness: {}\n# relaxation: {}\nshear_rate = {{ stiffness = \"{} N/m\", relaxation = \"{} s\" }}",
                sure(&rate.stiffness, "N/m", "all specimens"),
                sure(&rate.relaxation, "s", "all specimens"),
                short(rate.stiffness.value),
                short(rate.relaxation.value)
            );
        }

        // how far the specimens differ
        let scatter = self.scatter();
        if !scatter.is_empty() {
            text.push_str("\n[scatter]\n");
            for (key, share) in scatter {
                let _ = writeln!(text, "{key} = \"{} %\"", short(100.0 * share));
            }
        }
        text
    }

    /// The fitted values as a JSON object, in SI units.
    #[must_use]
    pub fn json(&self) -> Value {
        // JSON has no infinite numbers: a standard error that is not known is null
        let finite = |x: f64| if x.is_finite() { json!(x) } else { Value::Null };
        let estimate = |e: &Estimate| {
            let (sure, count) = match e.sure {
                Sure::Specimens(count) => ("specimens", count),
                Sure::Residuals(degrees) => ("residuals", degrees),
                Sure::Unknown => ("unknown", 0),
            };
            json!({
                "value": e.value,
                "standard_error": finite(e.error),
                "error_from": sure,
                "count": count,
                "interval_95": e.interval(),
                "scatter": e.scatter,
            })
        };

        // bending is one rigidity with those of the strips, or a curve
        let bending = |fit: &BendingFit| match fit {
            BendingFit::Rigidity(whole, each) => {
                let strips: Vec<Value> = each
                    .iter()
                    .map(|(name, [rigidity, angle])| {
                        json!({ "file": name, "rigidity": estimate(rigidity), "edge_angle": estimate(angle) })
                    })
                    .collect();
                json!({ "rigidity": estimate(whole), "strips": strips })
            }
            BendingFit::Curve(MomentFit { curve, scatter, .. }) => json!({
                "curvature": curve.curvature,
                "moment": curve.moment,
                "rigidity_at_rest": curve.rigidity(),
                "scatter": scatter,
            }),
        };

        let mut object = serde_json::Map::new();
        object.insert("test".into(), json!(self.test));
        object.insert("files".into(), json!(self.files));
        object.insert("notes".into(), json!(self.notes));
        if let Some(mass) = self.mass {
            object.insert("mass".into(), json!(mass));
        }

        // only what was fitted is in the object
        for (fit, along) in self.bending.iter().zip(DIRECTIONS) {
            if let Some(fit) = fit {
                object.insert(format!("bending_{along}"), bending(fit));
            }
        }
        if let Some(shear) = &self.shear {
            let shear = json!({
                "angle": shear.angle,
                "force": shear.force,
                "deviation": shear.deviation,
                "scatter": shear.scatter,
                "polynomial": shear.polynomial.map(|terms| terms.map(|[c, _]| c)),
                "polynomial_standard_error": shear.polynomial.map(|terms| terms.map(|[_, error]| error)),
                "locking_hint": shear.locking,
                "specimens": shear.reach.len(),
            });
            object.insert("shear".into(), shear);
        }
        if let Some(rate) = &self.rate {
            let rate = json!({
                "stiffness": estimate(&rate.stiffness),
                "relaxation": estimate(&rate.relaxation),
                "angle": rate.angle,
                "force": rate.force,
                "residual": rate.residual,
            });
            object.insert("shear_rate".into(), rate);
        }
        object.insert("toml".into(), json!(self.toml()));
        Value::Object(object)
    }
}
