//! `plydrape span`: one free length of ply between two ends, solved alone, by small-sag theory or as the elastica.

mod picture;
mod text;

use crate::argument::{refused, value};
use crate::failure::{Done, Failure};
use crate::results;
use plydrape::catenary::{EndCondition, Profile, Root, Span, SpanState, Station};
use plydrape::elastica::{Bending, HeavyStrip, Shape};
use plydrape::material::{MomentCurve, Section};
use plydrape_io::scene::{Measured, read_material, usual};
use plydrape_io::store::json;
use serde::Serialize;
use std::process::ExitCode;

/// Solve one span of ply between two ends: its force, sag, slopes and shape.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Plain numbers are in SI units, others carry a unit: 0.098 and \"98 mm\" are the same. A slope is rise \
over run. A negative force is compression. The shape is that of small-sag theory, unless --theory exact asks for the \
elastica: any sag, curvature exact, no stretch, and a moment that is a table where --material has one. A strip that bulges \
beyond its ends has its places at equal lengths along it.")]
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
    #[arg(
        long,
        value_name = "WEIGHT",
        allow_hyphen_values = true,
        required_unless_present = "material"
    )]
    weight: Option<String>,

    /// Flexural rigidity EI (N m^2).
    #[arg(
        long,
        value_name = "EI",
        allow_hyphen_values = true,
        required_unless_present = "material"
    )]
    rigidity: Option<String>,

    /// A shipped material or a material file, in place of weight and rigidity; with a mass per area it needs --width.
    #[arg(long, value_name = "NAME", conflicts_with_all = ["weight", "rigidity"])]
    material: Option<String>,

    /// Width of the strip of this material.
    #[arg(long, value_name = "LENGTH", requires = "material")]
    width: Option<String>,

    /// Which way the strip of this material runs.
    #[arg(long, value_enum, default_value_t = Along::Warp, requires = "material")]
    along: Along,

    /// Small sag in closed form, or the exact elastica.
    #[arg(long, value_enum, default_value_t = Theory::SmallSag)]
    theory: Theory,

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

/// Which way a strip runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Along {
    /// Along the warp.
    Warp,
    /// Along the weft.
    Weft,
}

/// How a span hangs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Theory {
    /// Small sag, in closed form.
    SmallSag,
    /// The inextensible elastica.
    Exact,
}

/// Acceleration of gravity of a strip of a material (m/s²), as in scenes.
const GRAVITY: f64 = 9.81;
/// Smallest and largest length (m), as in scenes.
const LENGTHS: [f64; 2] = [1e-6, 1e4];
/// Smallest and largest weight per length (N/m).
const WEIGHTS: [f64; 2] = [1e-9, 1e9];
/// Smallest flexural rigidity but zero, and the largest (N·m²).
const RIGIDITIES: [f64; 2] = [1e-18, 1e12];
/// Steepest slope and chord.
const STEEPEST: f64 = 1000.0;
/// Places that the table and the JSON object list.
const STATIONS: usize = 11;

/// Solves the span and prints it.
pub fn run(arguments: &Arguments) -> Done {
    let (span, curve) = arguments.span()?;
    let solved = match arguments.theory {
        Theory::SmallSag => Solved::new(span, curve.is_some())?,
        Theory::Exact => Solved::exact(span, curve)?,
    };
    let text = match arguments.json {
        true => json::to_text(&solved.printed())?,
        false => text::text(&solved),
    };
    results::print(&text, &[])?;
    Ok(ExitCode::SUCCESS)
}

impl Arguments {
    /// The span, each value held against its dimension and range, and its moment (N·m) where that is a table.
    fn span(&self) -> Result<(Span, Option<MomentCurve>), Failure> {
        // the two ends, and the length of fabric between them
        let length = "expected a length from 1 um to 10 km, e.g. \"98 mm\"";
        let run =
            value("--run", &self.run, Measured::Length, &usual::Span::USUAL, LENGTHS, length)?;
        let steepest = STEEPEST * run;
        let rise = value(
            "--rise",
            &self.rise,
            Measured::Length,
            &usual::Span::USUAL,
            [-steepest, steepest],
            "small-sag theory is for ends side by side: expected a rise of at most 1000 runs",
        )?;
        let length = value(
            "--length",
            &self.length,
            Measured::Length,
            &usual::Span::USUAL,
            LENGTHS,
            length,
        )?;

        // the strip: its weight, bending and stretch
        let (weight, flexural_rigidity, curve) = self.strip()?;
        let axial_stiffness = value(
            "--axial-stiffness",
            &self.axial_stiffness,
            Measured::Force,
            &usual::Axial::USUAL,
            [1e-3, f64::INFINITY],
            "expected a force from 1 mN, e.g. \"100 kN\", or inf for a ply that does not stretch",
        )?;
        if self.theory == Theory::Exact && axial_stiffness.is_finite() {
            return Err(refused(
                "--axial-stiffness",
                &self.axial_stiffness,
                "is for small-sag theory: the exact strip does not stretch",
                "leave it out with --theory exact",
            ));
        }

        let end = |option, text| end(option, text, flexural_rigidity);
        let span = Span {
            run,
            rise,
            length,
            ends: [end("--slope-start", &self.slope_start)?, end("--slope-end", &self.slope_end)?],
            weight,
            flexural_rigidity,
            axial_stiffness,
        };
        Ok((span, curve))
    }

    /// Weight per length (N/m), flexural rigidity (N·m²) and, where it is a table, the moment (N·m) of the strip.
    fn strip(&self) -> Result<(f64, f64, Option<MomentCurve>), Failure> {
        if let Some(name) = &self.material {
            return self.of_material(name);
        }
        let [weight, ei] =
            [&self.weight, &self.rigidity].map(|text| text.as_deref().unwrap_or("0"));
        let weight = value(
            "--weight",
            weight,
            Measured::ForcePerLength,
            &usual::Weight::USUAL,
            WEIGHTS,
            "expected a weight per length from 1e-9 to 1e9 N/m, e.g. 3.08 or \"3.08 N/m\"",
        )?;
        let rigidity = "expected a flexural rigidity from 1e-18 to 1e12 N m^2, or 0 for a ply \
                        that does not resist bending";
        let flexural_rigidity = value(
            "--rigidity",
            ei,
            Measured::FlexuralRigidity,
            &usual::Flexural::USUAL,
            [0.0, RIGIDITIES[1]],
            rigidity,
        )?;
        if flexural_rigidity > 0.0 && flexural_rigidity < RIGIDITIES[0] {
            return Err(refused("--rigidity", ei, "is too small", rigidity));
        }
        Ok((weight, flexural_rigidity, None))
    }

    /// Weight, rigidity and moment curve of a strip of a material.
    fn of_material(&self, name: &str) -> Result<(f64, f64, Option<MomentCurve>), Failure> {
        let material = read_material(name)?;
        let along = usize::from(self.along == Along::Weft);
        match (material.section, &self.width) {
            (Section::Line { mass, flexural_rigidity }, None) => {
                Ok((GRAVITY * mass, flexural_rigidity, None))
            }
            (Section::Line { .. }, Some(width)) => Err(refused(
                "--width",
                width,
                "is given with a material by line, which has a width of its own",
                "leave --width out",
            )),
            (Section::Areal { .. }, None) => Err(Failure::Refused {
                message: format!("the strip of {} has no width", material.name),
                help: "add --width, as in --width \"50 mm\"".into(),
            }),
            (Section::Areal { mass, warp_rigidity, weft_rigidity }, Some(width)) => {
                let help = "expected a width from 1 um to 10 km, e.g. \"50 mm\"";
                let width =
                    value("--width", width, Measured::Length, &usual::Span::USUAL, LENGTHS, help)?;
                let curve = material.moment[along].as_ref().map(|curve| curve.times(width));
                Ok((GRAVITY * mass * width, [warp_rigidity, weft_rigidity][along] * width, curve))
            }
        }
    }
}

/// What holds an end, from `free` or a slope.
fn end(option: &str, text: &str, flexural_rigidity: f64) -> Result<EndCondition, Failure> {
    if text.trim().eq_ignore_ascii_case("free") {
        return Ok(EndCondition::Free);
    }
    let help = "write free, or a slope as rise over run from -1000 to 1000, such as 0.5";
    let slope = value(option, text, Measured::Ratio, &usual::ANY, [-STEEPEST, STEEPEST], help)
        .map_err(|failure| match failure {
            Failure::Refused { message, .. } => Failure::Refused { message, help: help.into() },
            other => other,
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
    shape: SpanShape,
    /// Whether the moment is a table of which only the first slope was used.
    at_rest: bool,
}

/// The shape of a span.
enum SpanShape {
    /// A straight inextensible span, which has no force.
    Straight,
    /// The closed form of small sag.
    Small(Box<Profile>),
    /// The elastica.
    Exact(Box<Shape>),
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
    fn new(span: Span, at_rest: bool) -> Result<Solved, Failure> {
        let root = span.solve(None);
        if span.is_solved_by(&root) {
            let small = |force| SpanShape::Small(Box::new(Profile::new(&span, force)));
            let shape = root.force.map_or(SpanShape::Straight, small);
            return Ok(Solved { span, root, shape, at_rest });
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

    /// Solves a span as an elastica, or says why it has no hanging solution.
    fn exact(span: Span, curve: Option<MomentCurve>) -> Result<Solved, Failure> {
        let state = span.state();
        if state == SpanState::Straight {
            return Solved::new(span, false);
        }
        let bending = curve.map_or(Bending::Rigidity(span.flexural_rigidity), Bending::Curve);
        let Span { run, rise, length, ends, weight, .. } = span;
        let strip = HeavyStrip { run, rise, length, ends, weight, bending };
        let shape = strip.solve().map_err(|error| Failure::NoSolution {
            message: error.to_string(),
            help: "is a slope held the wrong way round, or the length far larger than the run? --theory small-sag may say more"
                .into(),
        })?;
        let force = Some(shape.horizontal_force());
        let root = Root { force, state, evaluations: 0, residual: 0.0 };
        Ok(Solved { span, root, shape: SpanShape::Exact(Box::new(shape)), at_rest: false })
    }

    /// Whether it is straight, without a force.
    fn is_straight(&self) -> bool {
        matches!(self.shape, SpanShape::Straight)
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

    /// The span at a share of its run; of its length where it bulges beyond its ends.
    fn station(&self, share: f64) -> Station {
        let x = share * self.span.run;
        match &self.shape {
            SpanShape::Straight => {
                let slope = self.span.rise / self.span.run;
                Station { x, z: slope * x, slope, moment: 0.0, vertical_force: 0.0 }
            }
            SpanShape::Small(profile) => profile.station(x),
            SpanShape::Exact(shape) => {
                let s = if share == 1.0 { None } else { shape.arc(x) };
                shape.station(s.unwrap_or(share * self.span.length))
            }
        }
    }

    fn stations(&self) -> impl Iterator<Item = Station> + '_ {
        (0..STATIONS).map(|n| self.station(n as f64 / (STATIONS - 1) as f64))
    }

    /// Largest vertical distance below the chord, and where (m).
    fn sag(&self) -> (f64, f64) {
        match &self.shape {
            SpanShape::Straight => (0.0, 0.0),
            SpanShape::Small(profile) => profile.sag(),
            SpanShape::Exact(shape) => {
                let (depth, s) = shape.sag();
                (depth, shape.at(s)[0])
            }
        }
    }

    fn slopes(&self) -> [f64; 2] {
        [0.0, 1.0].map(|end| self.station(end).slope)
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
