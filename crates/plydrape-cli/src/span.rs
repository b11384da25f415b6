//! `plydrape span`: one free length of ply between two ends, solved alone.

mod picture;
mod text;

use crate::argument::{refused, value};
use crate::failure::{Done, Failure};
use plydrape::catenary::{EndCondition, Profile, Root, Span, SpanState, Station};
use plydrape_io::json;
use plydrape_io::scene::Measured;
use serde::Serialize;
use std::io::{self, Write};
use std::process::ExitCode;

/// Solve one span of ply between two ends: its force, sag, slopes and shape.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Plain numbers are in SI units, others carry a unit: 0.098 and \"98 mm\" are the same. A slope is rise \
over run. A negative force is compression. The shape is that of small-sag theory.")]
pub struct Arguments {
    /// Horizontal distance of the ends.
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    run: String,

    /// Height of the end above the start.
    #[arg(long, value_name = "LENGTH", default_value = "0", allow_hyphen_values = true)]
    rise: String,

    /// Length of fabric between the ends.
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    length: String,

    /// Weight per length of fabric (N/m): mass per length times gravity.
    #[arg(long, value_name = "WEIGHT", allow_hyphen_values = true)]
    weight: String,

    /// Flexural rigidity EI (N m^2).
    #[arg(long, value_name = "EI", allow_hyphen_values = true)]
    rigidity: String,

    /// Slope held at the start, or `free`.
    #[arg(long, value_name = "SLOPE", default_value = "free", allow_hyphen_values = true)]
    slope_start: String,

    /// Slope held at the end, or `free`.
    #[arg(long, value_name = "SLOPE", default_value = "free", allow_hyphen_values = true)]
    slope_end: String,

    /// Axial stiffness EA (N), or `inf`.
    #[arg(long, value_name = "EA", default_value = "inf", allow_hyphen_values = true)]
    axial_stiffness: String,

    /// Print one JSON object on standard output instead of text.
    #[arg(long)]
    json: bool,
}

/// Smallest and largest length (m), as in scenes.
const LENGTHS: [f64; 2] = [1e-6, 1e4];
/// Smallest and largest weight per length (N/m).
const WEIGHTS: [f64; 2] = [1e-9, 1e9];
/// Smallest flexural rigidity but zero, and the largest (N·m²).
const RIGIDITIES: [f64; 2] = [1e-18, 1e12];
/// Steepest slope and chord.
const STEEPEST: f64 = 1000.0;
/// Error of the length, as a share of it, beyond which a span counts as not solved.
const LARGEST_RESIDUAL: f64 = 1e-6;
/// Places that the table and the JSON object list.
const STATIONS: usize = 11;

/// Solves the span and prints it.
pub fn run(arguments: &Arguments) -> Done {
    let span = arguments.span()?;
    let solved = Solved::new(span)?;
    let mut out = io::stdout().lock();
    if arguments.json {
        let text = json::of(&solved.printed()).map_err(plydrape_io::OutputError::from)?;
        out.write_all(text.as_bytes())?;
    } else {
        out.write_all(text::of(&solved).as_bytes())?;
    }
    out.flush()?;
    Ok(ExitCode::SUCCESS)
}

impl Arguments {
    /// The span, each value held against its dimension and range.
    fn span(&self) -> Result<Span, Failure> {
        let length = "a length from 1 um to 10 km is wanted, e.g. \"98 mm\"";
        let run = value("--run", &self.run, Measured::Length, LENGTHS, length)?;
        let steepest = STEEPEST * run;
        let rise = value(
            "--rise",
            &self.rise,
            Measured::Length,
            [-steepest, steepest],
            "small-sag theory is for ends side by side: a rise of at most 1000 runs is wanted",
        )?;
        let length = value("--length", &self.length, Measured::Length, LENGTHS, length)?;
        let weight = value(
            "--weight",
            &self.weight,
            Measured::ForcePerLength,
            WEIGHTS,
            "a weight per length from 1e-9 to 1e9 N/m is wanted, e.g. 3.08 or \"3.08 N/m\"",
        )?;
        let rigidity = "a flexural rigidity from 1e-18 to 1e12 N m^2 is wanted, or 0 for a ply \
                        that does not resist bending";
        let flexural_rigidity = value(
            "--rigidity",
            &self.rigidity,
            Measured::FlexuralRigidity,
            [0.0, RIGIDITIES[1]],
            rigidity,
        )?;
        if flexural_rigidity > 0.0 && flexural_rigidity < RIGIDITIES[0] {
            return Err(refused("--rigidity", &self.rigidity, "is too small", rigidity));
        }
        let axial_stiffness = value(
            "--axial-stiffness",
            &self.axial_stiffness,
            Measured::Force,
            [1e-3, f64::INFINITY],
            "a force from 1 mN is wanted, e.g. \"100 kN\", or inf for a ply that does not stretch",
        )?;
        let end = |option, text| end(option, text, flexural_rigidity);
        Ok(Span {
            run,
            rise,
            length,
            ends: [end("--slope-start", &self.slope_start)?, end("--slope-end", &self.slope_end)?],
            weight,
            flexural_rigidity,
            axial_stiffness,
        })
    }
}

/// What holds an end, from `free` or a slope.
fn end(option: &str, text: &str, flexural_rigidity: f64) -> Result<EndCondition, Failure> {
    if text.trim().eq_ignore_ascii_case("free") {
        return Ok(EndCondition::Free);
    }
    let help = "write free, or a slope as rise over run from -1000 to 1000, such as 0.5";
    let slope =
        value(option, text, Measured::Ratio, [-STEEPEST, STEEPEST], help).map_err(|failure| {
            match failure {
                Failure::Argument { message, .. } => {
                    Failure::Argument { message, help: help.into() }
                }
                other => other,
            }
        })?;
    if flexural_rigidity == 0.0 {
        let fault = "holds the slope of a ply that does not resist bending (--rigidity 0)";
        let help = format!("leave it free, as in {option} free, or give a rigidity above zero");
        return Err(refused(option, text, fault, &help));
    }
    Ok(EndCondition::Slope(slope))
}

/// A span and the force that gives it its length.
struct Solved {
    span: Span,
    root: Root,
    /// The closed form; none for a straight inextensible span, which has no force.
    profile: Option<Profile>,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Printed {
    #[serde(rename = "H_N")]
    force: Option<f64>,
    sag_mm: f64,
    slope_start: f64,
    slope_end: f64,
    x_mm: Vec<f64>,
    z_mm: Vec<f64>,
    state: &'static str,
}

impl Solved {
    /// Solves a span, or says that no force gives it its length.
    fn new(span: Span) -> Result<Solved, Failure> {
        let root = span.solve(None);
        let profile = root.force.map(|force| Profile::new(&span, force));
        let solved = Solved { span, root, profile };
        let is_finite = |s: Station| s.z.is_finite() && s.moment.is_finite();
        if root.residual <= LARGEST_RESIDUAL && solved.stations().all(is_finite) {
            return Ok(solved);
        }
        Err(Failure::NoSolution {
            message: "no horizontal force gives this span its length".into(),
            help: format!(
                "the nearest one found misses the length by {:.1e} of it: is a slope held the wrong \
                 way round, or the length far larger than the run?",
                root.residual
            ),
        })
    }

    /// How the span holds its length, briefly.
    fn state(&self) -> &'static str {
        let is_longer = self.span.chord() > self.span.length * (1.0 + 1e-13);
        match (self.root.state, self.root.force) {
            (SpanState::Hanging, Some(force)) if force < 0.0 => "in compression",
            (SpanState::Hanging, _) => "hanging",
            (SpanState::Straight, _) if !is_longer => "straight",
            (SpanState::Straight | SpanState::Overstretched, _) => "overstretched",
        }
    }

    /// The span at a distance from its start (m); without a profile on the straight chord.
    fn station(&self, x: f64) -> Station {
        let slope = self.span.rise / self.span.run;
        let straight = Station { x, z: slope * x, slope, moment: 0.0, vertical_force: 0.0 };
        self.profile.map_or(straight, |profile| profile.station(x))
    }

    fn stations(&self) -> impl Iterator<Item = Station> + '_ {
        (0..STATIONS).map(|n| self.station(self.span.run * n as f64 / (STATIONS - 1) as f64))
    }

    /// Largest vertical distance below the chord, and where (m).
    fn sag(&self) -> (f64, f64) {
        self.profile.map_or((0.0, 0.0), |profile| profile.sag())
    }

    fn slopes(&self) -> [f64; 2] {
        let chord = self.span.rise / self.span.run;
        [0, 1].map(|end| self.profile.map_or(chord, |p| p.end_slope(end)))
    }

    fn printed(&self) -> Printed {
        let [slope_start, slope_end] = self.slopes();
        Printed {
            force: self.root.force,
            sag_mm: self.sag().0 * 1e3,
            slope_start,
            slope_end,
            x_mm: self.stations().map(|s| s.x * 1e3).collect(),
            z_mm: self.stations().map(|s| s.z * 1e3).collect(),
            state: self.state(),
        }
    }
}
