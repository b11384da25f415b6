//! Laws of a material from the tables of its tests, and the lines of a material file that say them.

use crate::Error;
use crate::scene::{FitTable, Reading, read_fit};
use plydrape::fit::{
    BiasExtension, Estimate, Hang, Overhang, PictureFrame, ShearFit, ShearTest, Sure, fit_hang,
    fit_moments,
};
use plydrape::material::MomentCurve;
use serde_json::{Value, json};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Acceleration of gravity (m/s²), as in scenes.
const GRAVITY: f64 = 9.81;

/// A test of a material; what is not given is looked for in the comments of its files.
#[derive(Debug, Clone, PartialEq)]
pub enum Test {
    /// Bias extension: width and length of the specimens (m).
    Bias {
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
}

/// Bending along one direction.
#[derive(Debug, Clone, PartialEq)]
pub enum BendingFit {
    /// A rigidity per width (N·m), and each strip's with its angle at the edge (rad) where points were fitted.
    Rigidity(Estimate, Vec<(String, [Estimate; 2])>),
    /// A curve of the moment with the scatter between specimens.
    Curve(MomentCurve, Option<f64>),
}

/// A fitted law.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The test in words.
    pub test: String,
    /// The files that it comes from.
    pub files: Vec<String>,
    /// Mass per area that was used (kg/m²).
    pub mass: Option<f64>,
    /// Bending along warp and weft.
    pub bending: [Option<BendingFit>; 2],
    /// Shear.
    pub shear: Option<ShearFit>,
}

/// Fits a law.
///
/// # Errors
/// If a table is broken, a measure is missing, or the points say no law.
pub fn fit(request: &Request) -> Result<Fitted, Error> {
    let all = request.warp.iter().chain(&request.weft);
    let mut fitted = Fitted {
        test: String::new(),
        files: all.map(|path| name(path)).collect(),
        mass: None,
        bending: [None, None],
        shear: None,
    };
    let of = |reading: Reading| -> Result<[Vec<(String, FitTable)>; 2], Error> {
        let read = |paths: &[PathBuf]| -> Result<Vec<_>, Error> {
            paths.iter().map(|path| Ok((name(path), read_fit(path, reading)?))).collect()
        };
        Ok([read(&request.warp)?, read(&request.weft)?])
    };
    match &request.test {
        Test::Bias { width, length } => {
            let [tables, _] = of(Reading::Pull)?;
            let width = measure("width", *width, &tables)?;
            let length = measure("length", *length, &tables)?;
            let test = ShearTest::Bias(BiasExtension { width, length });
            fitted.shear = Some(test.fit(&points(&tables))?);
            let [w, l] = [width, length].map(|x| short(1e3 * x));
            fitted.test = format!("bias extension, {} of {w} x {l} mm", specimens(tables.len()));
        }
        Test::Frame { side, fabric } => {
            let [tables, _] = of(Reading::Pull)?;
            let side = measure("side", *side, &tables)?;
            let fabric = fabric.or_else(|| stated("fabric", &tables)).unwrap_or(side);
            let test = ShearTest::Frame(PictureFrame { side, fabric });
            fitted.shear = Some(test.fit(&points(&tables))?);
            let side = short(1e3 * side);
            fitted.test = format!("picture frame of {side} mm, {}", specimens(tables.len()));
        }
        Test::Overhang { mass, angle } => {
            let tables = of(Reading::Overhang)?;
            let areal = mass_of(*mass, &tables)?;
            fitted.mass = Some(areal);
            let test = Overhang { weight: GRAVITY * areal, angle: *angle };
            for (n, tables) in tables.iter().enumerate() {
                let overhangs: Vec<f64> = tables
                    .iter()
                    .flat_map(|(_, table)| table.rows.iter().map(|row| row[0]))
                    .collect();
                if !tables.is_empty() {
                    fitted.bending[n] =
                        Some(BendingFit::Rigidity(test.fit(&overhangs)?, Vec::new()));
                }
            }
            fitted.test = format!("cantilever, chord at {} deg", short(angle.to_degrees()));
        }
        Test::Hang { mass, length } => {
            let tables = of(Reading::Points)?;
            let areal = mass_of(*mass, &tables)?;
            fitted.mass = Some(areal);
            for (n, tables) in tables.iter().enumerate() {
                let mut strips = Vec::with_capacity(tables.len());
                for (name, table) in tables {
                    let own = length.or(table.stated("length"));
                    let length = own.ok_or_else(|| missing("length"))?;
                    let points = table.rows.clone();
                    strips.push((name.clone(), Hang { points, length, weight: GRAVITY * areal }));
                }
                if !strips.is_empty() {
                    let (whole, each) = fit_hang(&strips)?;
                    let names = strips.into_iter().map(|(name, _)| name);
                    fitted.bending[n] =
                        Some(BendingFit::Rigidity(whole, names.zip(each).collect()));
                }
            }
            fitted.test = "points of hanging strips, fitted by the exact elastica".into();
        }
        Test::Moments => {
            let tables = of(Reading::Moment)?;
            for (n, tables) in tables.iter().enumerate() {
                if !tables.is_empty() {
                    let specimens: Vec<_> =
                        tables.iter().map(|(name, t)| (name.clone(), t.rows.clone())).collect();
                    let (curve, scatter) = fit_moments(&specimens)?;
                    fitted.bending[n] = Some(BendingFit::Curve(curve, scatter));
                }
            }
            fitted.test = "moment over curvature, mean of both sides and both ways".into();
        }
    }
    Ok(fitted)
}

fn specimens(count: usize) -> String {
    if count == 1 { "one specimen".into() } else { format!("{count} specimens") }
}

fn name(path: &Path) -> String {
    crate::store::shown::path(path).to_string()
}

fn points(tables: &[(String, FitTable)]) -> Vec<Vec<[f64; 2]>> {
    tables.iter().map(|(_, table)| table.rows.clone()).collect()
}

fn stated(key: &str, tables: &[(String, FitTable)]) -> Option<f64> {
    tables.iter().find_map(|(_, table)| table.stated(key))
}

fn missing(what: &'static str) -> Error {
    let value = if what == "mass" { "314 g/m^2" } else { "100 mm" };
    let help =
        format!("give --{what} \"{value}\", or a line `# {what} = {value}` at the top of the file");
    Error::not_possible(format!("the {what} of the specimens is given nowhere"), help)
}

fn measure(
    what: &'static str,
    given: Option<f64>,
    tables: &[(String, FitTable)],
) -> Result<f64, Error> {
    given.or_else(|| stated(what, tables)).ok_or_else(|| missing(what))
}

fn mass_of(given: Option<f64>, tables: &[Vec<(String, FitTable)>; 2]) -> Result<f64, Error> {
    let stated = tables.iter().find_map(|tables| stated("mass", tables));
    given.or(stated).ok_or_else(|| missing("mass"))
}

/// Four digits.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.3e}").parse().unwrap_or(value);
    if rounded != 0.0 && !(1e-3..1e6).contains(&rounded.abs()) {
        format!("{rounded:e}")
    } else {
        format!("{rounded}")
    }
}

/// What an estimate's error is, in words.
fn sure(estimate: &Estimate, unit: &str) -> String {
    let Some([low, high]) = estimate.interval() else {
        return "one specimen: how sure it is, is not known".into();
    };
    let from = match estimate.sure {
        Sure::Specimens(count) => format!("from {count} specimens"),
        _ => "from the residuals of one specimen".into(),
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
                Some(BendingFit::Curve(_, scatter)) => *scatter,
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
        let list = |values: &[f64], unit: &str| {
            let items: Vec<String> = values
                .iter()
                .map(|v| if *v == 0.0 { "0".into() } else { format!("\"{}{unit}\"", short(*v)) })
                .collect();
            items.join(", ")
        };
        let quoted = |text: &str| text.replace('\\', "/").replace('"', "'");
        let mut text = format!(
            "# Fitted by {}. A material file needs `mass`, bending along warp and weft, and for the sheet `tension` and `shear_curve`.\n",
            crate::PROGRAM
        );
        let _ = writeln!(text, "source = \"fitted from {}\"", quoted(&self.files.join(", ")));
        let _ = writeln!(text, "test = \"{}\"", quoted(&self.test));
        if let Some(mass) = self.mass {
            let _ = writeln!(text, "mass = \"{} kg/m^2\"", short(mass));
        }
        for (bending, along) in self.bending.iter().zip(DIRECTIONS) {
            match bending {
                Some(BendingFit::Rigidity(estimate, each)) => {
                    let _ = writeln!(
                        text,
                        "# {}\nbending_rigidity_{along} = \"{} N m\"",
                        sure(estimate, "N m"),
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
                Some(BendingFit::Curve(curve, _)) => {
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
        if let Some(shear) = &self.shear {
            let degrees: Vec<f64> = shear.angle.iter().map(|angle| angle.to_degrees()).collect();
            let terms: Vec<String> = shear
                .polynomial
                .iter()
                .map(|[c, error]| format!("{} ± {}", short(*c), short(*error)))
                .collect();
            let _ = writeln!(
                text,
                "# as a polynomial of the angle in rad: {} N/m (standard errors from the residuals)",
                terms.join(", ")
            );
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
        let scatter = self.scatter();
        if !scatter.is_empty() {
            text.push_str("\n[scatter]\n");
            for (key, share) in scatter {
                let _ = writeln!(text, "{key} = \"{} %\"", short(100.0 * share));
            }
        }
        text
    }

    /// The same as an object, all numbers in SI units.
    #[must_use]
    pub fn json(&self) -> Value {
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
            BendingFit::Curve(curve, scatter) => json!({
                "curvature": curve.curvature,
                "moment": curve.moment,
                "rigidity_at_rest": curve.rigidity(),
                "scatter": scatter,
            }),
        };
        let mut object = serde_json::Map::new();
        object.insert("test".into(), json!(self.test));
        object.insert("files".into(), json!(self.files));
        if let Some(mass) = self.mass {
            object.insert("mass".into(), json!(mass));
        }
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
                "polynomial": shear.polynomial.map(|[c, _]| c),
                "polynomial_standard_error": shear.polynomial.map(|[_, error]| error),
                "locking_hint": shear.locking,
                "specimens": shear.specimens,
            });
            object.insert("shear".into(), shear);
        }
        object.insert("toml".into(), json!(self.toml()));
        Value::Object(object)
    }
}
