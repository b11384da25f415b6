//! `plydrape fit`: laws of a material from tables of its tests.

use crate::argument::value;
use crate::failure::{Done, Failure};
use crate::new::put;
use crate::results;
use crate::watch::whole;
use plydrape_io::fit::{Request, Test, fit};
use plydrape_io::scene::{Measured, usual};
use plydrape_io::store::shown;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Fit laws of a material to tables of its tests: shear, bending, with how sure they are.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
A table is a CSV file that names its columns with their units above its numbers, as in `displacement (mm),force (N)`. Lines such as \
`# width = 100 mm` above it state the measures of its own specimen; options state those of files that do not.

The answer is the lines of a material file, on standard output or in a new file.")]
pub struct Arguments {
    #[command(subcommand)]
    test: Kind,

    /// A new file for the lines; what exists is not overwritten.
    #[arg(short, long, value_name = "FILE", global = true)]
    output: Option<PathBuf>,

    /// Print one JSON object on standard output instead of text.
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Debug, clap::Subcommand)]
enum Kind {
    /// A shear curve from bias extension: displacement and force, one file a specimen.
    Bias(Pulled),
    /// What resin adds to shear, from bias extension in time: displacement, force and time, strips at two speeds or more, or held.
    Rate(Pulled),
    /// A shear curve from a picture frame: displacement and force, one file a specimen.
    Frame {
        /// The tables, one a specimen.
        #[arg(required = true)]
        files: Vec<PathBuf>,
        /// Side of the frame from hinge to hinge.
        #[arg(long, value_name = "LENGTH")]
        side: Option<String>,
        /// Side of the fabric that shears in it; that of the frame unless given.
        #[arg(long, value_name = "LENGTH")]
        fabric: Option<String>,
        /// Title of the column of displacements, where it has another name than usual.
        #[arg(long, value_name = "TITLE")]
        displacement: Option<String>,
        /// Title of the column of forces.
        #[arg(long, value_name = "TITLE")]
        force: Option<String>,
    },
    /// Bending rigidities from overhangs at 41.5 deg (Peirce): a column `overhang`, one row a specimen.
    Overhang {
        #[command(flatten)]
        strips: Strips,
        /// Mass per area.
        #[arg(long, value_name = "MASS")]
        mass: Option<String>,
        /// Angle of the chord from edge to tip below the level.
        #[arg(long, value_name = "ANGLE", default_value = "41.5 deg")]
        angle: String,
        /// Title of the column of overhangs, where it has another name than usual.
        #[arg(long, value_name = "TITLE")]
        overhang: Option<String>,
    },
    /// Bending rigidities from points x, z of strips that hang over an edge, one file a strip.
    Hang {
        #[command(flatten)]
        strips: Strips,
        /// Mass per area.
        #[arg(long, value_name = "MASS")]
        mass: Option<String>,
        /// Length of the overhang.
        #[arg(long, value_name = "LENGTH")]
        length: Option<String>,
        /// Title of the column of x, where it has another name.
        #[arg(long, value_name = "TITLE")]
        x: Option<String>,
        /// Title of the column of z.
        #[arg(long, value_name = "TITLE")]
        z: Option<String>,
    },
    /// Moment over curvature from bending tests: curvature and moment per width, one file a specimen.
    Moments {
        #[command(flatten)]
        strips: Strips,
        /// Title of the column of curvatures, where it has another name than usual.
        #[arg(long, value_name = "TITLE")]
        curvature: Option<String>,
        /// Title of the column of moments per width.
        #[arg(long, value_name = "TITLE")]
        moment: Option<String>,
    },
}

/// Tables of bias strips.
#[derive(Debug, clap::Args)]
struct Pulled {
    /// The tables, one a specimen.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Width of the specimens.
    #[arg(long, value_name = "LENGTH")]
    width: Option<String>,
    /// Length between the clamps, two widths or more.
    #[arg(long, value_name = "LENGTH")]
    length: Option<String>,
    /// Title of the column of displacements, where it has another name than usual.
    #[arg(long, value_name = "TITLE")]
    displacement: Option<String>,
    /// Title of the column of forces.
    #[arg(long, value_name = "TITLE")]
    force: Option<String>,
}

/// Tables of strips of both directions.
#[derive(Debug, clap::Args)]
struct Strips {
    /// Tables of strips along the warp.
    #[arg(long, value_name = "FILE", num_args = 1.., required_unless_present = "weft")]
    warp: Vec<PathBuf>,
    /// Tables of strips along the weft.
    #[arg(long, value_name = "FILE", num_args = 1..)]
    weft: Vec<PathBuf>,
}

/// Smallest and largest length (m), as in scenes.
const LENGTHS: [f64; 2] = [1e-6, 1e4];

/// Fits and prints.
pub fn run(arguments: &Arguments, quiet: bool) -> Done {
    let request = arguments.test.request()?;
    let fitted = fit(&request)?;
    let toml = fitted.toml();
    let mut files = Vec::new();
    if let Some(file) = &arguments.output {
        let folder = file.parent().filter(|f| *f != Path::new("")).unwrap_or(Path::new("."));
        whole(|| put(file, folder, &toml)).map_err(|error| Failure::output(file, &error))?;
        files.push(file.clone());
    }
    let text = match &arguments.output {
        _ if arguments.json => format!("{:#}\n", fitted.json()),
        Some(_) if quiet => String::new(),
        Some(file) => {
            let notes = fitted.notes.iter().map(|note| format!("  {note}\n"));
            format!("{} is written\n{}", shown::path(file), notes.collect::<String>())
        }
        None => toml,
    };
    results::print(&text, &files)?;
    Ok(ExitCode::SUCCESS)
}

impl Kind {
    fn request(&self) -> Result<Request, Failure> {
        // measures of the specimens may be left out: a table may state those of its own
        let length = |option: &str, text: &Option<String>| {
            let help = "expected a length from 1 um to 10 km, e.g. \"100 mm\"";
            text.as_ref()
                .map(|text| {
                    value(option, text, Measured::Length, &usual::Coupon::USUAL, LENGTHS, help)
                })
                .transpose()
        };
        let areal = |text: &Option<String>| {
            let help = "expected a mass per area from 1 mg/m^2 to 1000 kg/m^2, e.g. \"314 g/m^2\"";
            text.as_ref()
                .map(|text| {
                    value(
                        "--mass",
                        text,
                        Measured::ArealMass,
                        &usual::PlyMass::USUAL,
                        [1e-6, 1e3],
                        help,
                    )
                })
                .transpose()
        };

        // each test has its own measures and its own columns
        Ok(match self {
            // shear: a table gives displacement and force
            Kind::Bias(strips) => {
                let [width, length] = strips.sizes(length)?;
                strips.request(Test::Bias { width, length })
            }
            Kind::Rate(strips) => {
                let [width, length] = strips.sizes(length)?;
                strips.request(Test::Rate { width, length })
            }
            Kind::Frame { files, side, fabric, displacement, force } => Request {
                test: Test::Frame {
                    side: length("--side", side)?,
                    fabric: length("--fabric", fabric)?,
                },
                warp: files.clone(),
                weft: Vec::new(),
                titles: [displacement.clone(), force.clone()],
            },
            // bending: tables of strips along the warp and along the weft
            Kind::Overhang { strips, mass, angle, overhang } => {
                let help = "expected an angle from 1 to 89 deg, e.g. \"41.5 deg\"";
                let range = [1.0_f64, 89.0].map(f64::to_radians);
                let angle =
                    value("--angle", angle, Measured::Angle, &usual::AnyAngle::USUAL, range, help)?;
                strips
                    .request(Test::Overhang { mass: areal(mass)?, angle }, [overhang.clone(), None])
            }
            Kind::Hang { strips, mass, length: l, x, z } => {
                let test = Test::Hang { mass: areal(mass)?, length: length("--length", l)? };
                strips.request(test, [x.clone(), z.clone()])
            }
            Kind::Moments { strips, curvature, moment } => {
                strips.request(Test::Moments, [curvature.clone(), moment.clone()])
            }
        })
    }
}

impl Pulled {
    /// Width and length (m) where they are given; `read` reads the length of an option.
    fn sizes(
        &self,
        read: impl Fn(&str, &Option<String>) -> Result<Option<f64>, Failure>,
    ) -> Result<[Option<f64>; 2], Failure> {
        Ok([read("--width", &self.width)?, read("--length", &self.length)?])
    }

    fn request(&self, test: Test) -> Request {
        let titles = [self.displacement.clone(), self.force.clone()];
        Request { test, warp: self.files.clone(), weft: Vec::new(), titles }
    }
}

impl Strips {
    fn request(&self, test: Test, titles: [Option<String>; 2]) -> Request {
        Request { test, warp: self.warp.clone(), weft: self.weft.clone(), titles }
    }
}
